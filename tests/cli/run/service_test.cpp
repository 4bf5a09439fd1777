/// What a service manager is told by a run, and by its supervisor.

#include "tests/proc.h"
#include "tests/programs/becomes.h"
#include "tests/programs/desk.h"
#include "tests/programs/notify_socket.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>
#include <unistd.h>

namespace stadion {
namespace {

const char* const kPing = "WATCHDOG=1\n";

/// A live run whose manager has a watchdog of 0.4 s.
class Service {
public:
  explicit Service(std::vector<std::string> more)
      : socket_(fmt::format("@stadion-service-test-{}", getpid())),
        program_(wordsOf(std::move(more), socket_)) {}

  RunningProgram& program() { return program_; }
  /// Waits until it has told this; false if it ends before.
  bool tells(const std::string& part) {
    return program_.waitUntil([&] {
      take();
      return std::ranges::any_of(told_, [&](const std::string& t) { return has(t, part); });
    });
  }
  bool pings(std::size_t more) {
    const std::size_t before = pingsSoFar();
    return program_.waitUntil([&] { return pingsSoFar() >= before + more; });
  }
  /// Waits until no ping has come for a second, more than twice the watchdog's limit.
  bool fallsSilent() {
    return becomes([&] {
      const std::size_t before = pingsSoFar();
      for (int i = 0; i < 100 && pingsSoFar() == before; ++i)
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
      return pingsSoFar() == before;
    });
  }
  std::size_t pingsSoFar() {
    take();
    return static_cast<std::size_t>(std::ranges::count(told_, kPing));
  }
  const std::vector<std::string>& told() const { return told_; }

private:
  static ProgramRun wordsOf(std::vector<std::string> more, const NotifySocket& socket) {
    ProgramRun run{{stadionPath(), "run", STADION_SOURCE_DIR "/scripts/kick.evs", "--input", "none",
                    "--walls", "powerwall", "--size", "32x24", "--stereo", "off", "--renderer", "cpu",
                    "--no-sound"}};
    run.words.insert(run.words.end(), more.begin(), more.end());
    run.environment = {"NOTIFY_SOCKET=" + socket.address(), "WATCHDOG_USEC=400000"};
    return run;
  }
  void take() {
    for (std::string& text : socket_.all()) told_.push_back(std::move(text));
  }

  NotifySocket socket_;
  std::vector<std::string> told_;
  RunningProgram program_;
};

TEST(ProgramService, ARunIsReadyWithItsFirstPicturePingsWithLaterOnesAndTellsItsEnd) {
  Service service({});
  ASSERT_TRUE(service.tells("READY=1")) << service.program().err();
  EXPECT_TRUE(has(service.told().front(), "STATUS=plays ")) << service.told().front();
  EXPECT_TRUE(service.pings(4));
  kill(service.program().pid(), SIGTERM);
  EXPECT_EQ(service.program().status(), 143);
  service.pingsSoFar();
  EXPECT_TRUE(has(service.told().back(), "STOPPING=1")) << service.told().back();
}

TEST(ProgramService, AFrameLoopThatHangsPingsNoMore) {
  // From the thirtieth frame on, its Draw sleeps.
  const TestFolder folder;
  Service service({"--plant", "draw:screen=sleep600000ms/1000000+30", "--seconds", "600", "--spans",
                   folder.path() / "spans"});
  ASSERT_TRUE(service.tells("READY=1")) << service.program().err();
  EXPECT_TRUE(service.fallsSilent());
  EXPECT_TRUE(service.program().runs());
}

TEST(ProgramService, ASupervisorSpeaksForItsPlayersAndPingsWhileOneIsReplaced) {
  Service service({"--supervise"});
  ASSERT_TRUE(service.tells("READY=1")) << service.program().err();
  EXPECT_TRUE(service.pings(2));
  const pid_t player = procChild(service.program().pid());
  ASSERT_GT(player, 0);
  kill(player, SIGKILL);
  EXPECT_TRUE(service.tells("STATUS=the player was ended by signal 9"));
  EXPECT_TRUE(service.pings(2));
  EXPECT_TRUE(service.program().waitUntil([&] {
    const pid_t next = procChild(service.program().pid());
    return next > 0 && next != player;
  }));
  kill(service.program().pid(), SIGTERM);
  EXPECT_EQ(service.program().status(), 143);
  EXPECT_EQ(std::ranges::count_if(service.told(), [](const std::string& t) { return has(t, "READY=1"); }), 1);
  service.pingsSoFar();
  EXPECT_TRUE(std::ranges::any_of(service.told(), [](const std::string& t) { return has(t, "STOPPING=1"); }));
}

TEST(ProgramService, AHangingPlayerStopsThePingsUntilTheNextOnePlays) {
  Service service({"--supervise", "--hang-after", "2"});
  ASSERT_TRUE(service.tells("READY=1")) << service.program().err();
  EXPECT_TRUE(service.pings(2));
  const pid_t player = procChild(service.program().pid());
  ASSERT_GT(player, 0);
  kill(player, SIGSTOP);
  EXPECT_TRUE(service.fallsSilent());
  EXPECT_TRUE(service.tells("showed nothing for 2 s and was killed"));
  EXPECT_TRUE(service.pings(2));
}

}  // namespace
}  // namespace stadion
