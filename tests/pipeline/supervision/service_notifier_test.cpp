/// What a service manager is told, by real datagrams.

#include "pipeline/supervision/service_notifier.h"
#include "tests/programs/notify_socket.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fmt/format.h>
#include <unistd.h>

namespace stadion {
namespace {

using Lines = std::vector<std::string>;

Nanoseconds serviceClock = 0;
Nanoseconds readServiceClock() {
  return serviceClock;
}

/// A manager with a watchdog of 4 s, and what it is told.
struct Manager {
  explicit Manager(const std::string& kind, Nanoseconds watchdog = fromSeconds(4))
      : socket(fmt::format(fmt::runtime(kind), getpid())) {
    serviceClock = fromSeconds(100);
    notifier = ServiceNotifier::open({socket.address(), watchdog}, readServiceClock);
  }
  ~Manager() {
    if (socket.address().front() == '/') unlink(socket.address().c_str());
  }
  NotifySocket socket;
  std::unique_ptr<ServiceNotifier> notifier;
};

constexpr const char* kAbstract = "@stadion-test-{}";
const std::string kPing = "WATCHDOG=1\n";

TEST(ServiceNotifier, TheFirstPictureMakesAServiceReadyUnderAPathAndUnderAnAbstractName) {
  for (const char* kind : {"/tmp/stadion-test-{}.socket", kAbstract}) {
    const Manager m(kind);
    ASSERT_TRUE(m.socket.isOpen() && m.notifier) << kind;
    EXPECT_EQ(m.socket.all(), Lines{});
    EXPECT_FALSE(m.notifier->isReady());
    m.notifier->pictureShown("plays\nMAINPID=1");
    EXPECT_EQ(m.socket.all(), Lines{"READY=1\nSTATUS=plays MAINPID=1\n"}) << "a text is no variable";
    EXPECT_TRUE(m.notifier->isReady());
  }
}

TEST(ServiceNotifier, PingsComeFourTimesInALimitAndOnlyWithPictures) {
  const Manager m(kAbstract);
  ASSERT_TRUE(m.notifier);
  m.notifier->pictureShown("plays");
  m.socket.all();
  std::size_t pings = 0;
  for (int frame = 0; frame < 600; ++frame) {  // ten seconds at 60 Hz
    serviceClock += fromSeconds(1) / 60;
    m.notifier->pictureShown("plays");
    for (const std::string& text : m.socket.all()) {
      EXPECT_EQ(text, kPing);
      ++pings;
    }
  }
  EXPECT_EQ(pings, 9U);
  serviceClock += fromSeconds(60);  // no picture is finished
  m.notifier->status("plays on");
  EXPECT_EQ(m.socket.all(), Lines{"STATUS=plays on\n"});
  m.notifier->pictureShown("plays");
  EXPECT_EQ(m.socket.all(), Lines{kPing});
}

TEST(ServiceNotifier, WithoutAWatchdogThereAreNoPings) {
  const Manager m(kAbstract, 0);
  ASSERT_TRUE(m.notifier);
  m.notifier->pictureShown("plays");
  m.socket.all();
  serviceClock += fromSeconds(100);
  m.notifier->pictureShown("plays");
  m.notifier->alive();
  m.notifier->mayPause(true);
  EXPECT_EQ(m.socket.all(), Lines{});
}

TEST(ServiceNotifier, WhileFilesAreOpenedTheLimitIsLongerUntilThePictureAfterwards) {
  const Manager m(kAbstract);
  ASSERT_TRUE(m.notifier);
  m.notifier->pictureShown("plays");
  m.socket.all();
  m.notifier->mayPause(true);
  EXPECT_EQ(m.socket.all(), Lines{"WATCHDOG_USEC=48000000\nWATCHDOG=1\n"});
  m.notifier->pictureShown("plays");
  EXPECT_EQ(m.socket.all(), Lines{}) << "a frame that was in flight";
  m.notifier->mayPause(false);
  EXPECT_EQ(m.socket.all(), Lines{});
  m.notifier->pictureShown("plays");
  EXPECT_EQ(m.socket.all(), Lines{"WATCHDOG_USEC=4000000\nWATCHDOG=1\n"});
}

TEST(ServiceNotifier, AManagerThatDoesNotReadBlocksNothingAndLearnsLaterThatItIsReady) {
  const Manager m(kAbstract);
  ASSERT_TRUE(m.notifier);
  for (int i = 0; i < 100'000; ++i) m.notifier->status(std::to_string(i));  // more than any queue holds
  m.notifier->pictureShown("plays");
  EXPECT_FALSE(m.notifier->isReady());
  m.socket.all();
  m.notifier->pictureShown("plays");
  EXPECT_EQ(m.socket.all(), Lines{"READY=1\nSTATUS=plays\n"});
}

TEST(ServiceNotifier, TheEndIsToldOnce) {
  const Manager m(kAbstract);
  ASSERT_TRUE(m.notifier);
  m.notifier->stopping();
  m.notifier->stopping();
  EXPECT_EQ(m.socket.all(), Lines{"STOPPING=1\nSTATUS=ends\n"});
}

TEST(ServiceNotifier, AddressesThatAreNoneOpenNothing) {
  for (const std::string& none : {std::string(), std::string("@"), std::string("/"), std::string("relative"),
                                  std::string("vsock:2:1234"), "/" + std::string(107, 'x')})
    EXPECT_FALSE(ServiceNotifier::open({none, 0})) << none;
  EXPECT_TRUE(ServiceNotifier::open({"@" + std::string(107, 'x'), 0}));
  EXPECT_TRUE(ServiceNotifier::open({"/" + std::string(106, 'x'), 0}));
}

TEST(ServiceNotifier, TheEnvironmentSaysWhereAndIsCleared) {
  const auto read = [](const char* pid, const char* limit) {
    setenv("NOTIFY_SOCKET", "@here", 1);
    limit ? setenv("WATCHDOG_USEC", limit, 1) : unsetenv("WATCHDOG_USEC");
    pid ? setenv("WATCHDOG_PID", pid, 1) : unsetenv("WATCHDOG_PID");
    const ServiceAddress address = ServiceAddress::ofEnvironment();
    EXPECT_EQ(address.socket, "@here");
    for (const char* name : {"NOTIFY_SOCKET", "WATCHDOG_USEC", "WATCHDOG_PID"})
      EXPECT_EQ(std::getenv(name), nullptr) << "programs that are started later must not speak for this one";
    return address.watchdog;
  };
  const std::string own = std::to_string(getpid()), other = std::to_string(getpid() + 1);
  EXPECT_EQ(read(own.c_str(), "30000000"), fromSeconds(30));
  EXPECT_EQ(read(nullptr, "30000000"), fromSeconds(30));
  EXPECT_EQ(read(other.c_str(), "30000000"), 0) << "the watchdog of another process";
  EXPECT_EQ(read(own.c_str(), nullptr), 0);
  for (const char* wrong : {"", "-1", "3s", "99999999999999999999"})
    EXPECT_EQ(read(nullptr, wrong), 0) << wrong;
  EXPECT_TRUE(ServiceAddress::ofEnvironment().socket.empty());
}

}  // namespace
}  // namespace stadion
