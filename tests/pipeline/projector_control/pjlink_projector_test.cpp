/// PJLink against projectors on loopback that answer well, wrongly, slowly or not at all.

#include "pipeline/projector_control/pjlink_line.h"
#include "pipeline/projector_control/pjlink_projector.h"
#include "tests/pipeline/projector_control/fake_projector.h"

#include <gtest/gtest.h>

#include <map>
#include <mutex>
#include <random>
#include <string>

namespace stadion {
namespace {

using test::FakeProjector;

FakeProjector::Answer answers(std::map<std::string, std::string> table) {
  return [table = std::move(table)](const std::string& line) {
    const auto at = table.find(line);
    return at == table.end() ? line.substr(0, 6) + "=ERR1\r" : at->second;
  };
}

TEST(Pjlink, DigestIsThatOfTheSpecification) {
  EXPECT_EQ(pjlink::digestOf("498e4a67", "JBMIAProjectorLink"), "5d8409bc1c3fa39749434aa3a5c38682");
}

TEST(Pjlink, SwitchesAndAsksAProjectorWithoutPassword) {
  FakeProjector projector("PJLINK 0\r", answers({{"%1POWR 1", "%1POWR=OK\r"},
                                                 {"%1AVMT 31", "%1AVMT=OK\r"},
                                                 {"%1POWR ?", "%1POWR=3\r"},
                                                 {"%1AVMT ?", "%1AVMT=31\r"},
                                                 {"%1ERST ?", "%1ERST=010020\r"},
                                                 {"%1LAMP ?", "%1LAMP=1234 1 77 0\r"},
                                                 {"%1INF1 ?", "%1INF1=Maker\r"},
                                                 {"%1INF2 ?", "%1INF2=Model \x01 7\r"}}));
  auto opened = PjlinkProjector::open(projector.address());
  ASSERT_TRUE(opened) << opened.error().message;
  PjlinkProjector& p = *opened.value();
  EXPECT_FALSE(p.setPower(true));
  EXPECT_FALSE(p.setShutter(true));
  const auto status = p.status();
  ASSERT_TRUE(status) << status.error().message;
  EXPECT_EQ(status.value().power, PjlinkStatus::Power::Warming);
  EXPECT_TRUE(status.value().shut);
  EXPECT_EQ(status.value().faults, (std::vector<std::string>{"lamp: warning", "filter: error"}));
  EXPECT_EQ(status.value().lampHours, (std::vector<std::uint32_t>{1234, 77}));
  EXPECT_EQ(status.value().model, "Model  7");
}

TEST(Pjlink, GivesTheDigestBeforeTheFirstCommandAlone) {
  std::vector<std::string> heard;
  std::mutex mutex;
  FakeProjector projector("PJLINK 1 498e4a67\r", [&](const std::string& line) {
    const std::lock_guard lock(mutex);
    heard.push_back(line);
    return std::string("%1POWR=OK\r");
  });
  auto p = PjlinkProjector::open(projector.address("JBMIAProjectorLink"));
  ASSERT_TRUE(p) << p.error().message;
  EXPECT_FALSE(p.value()->setPower(true));
  EXPECT_FALSE(p.value()->setPower(false));
  const std::lock_guard lock(mutex);
  EXPECT_EQ(heard, (std::vector<std::string>{"5d8409bc1c3fa39749434aa3a5c38682%1POWR 1", "%1POWR 0"}));
}

TEST(Pjlink, SaysWhatAProjectorRefuses) {
  FakeProjector projector("PJLINK 0\r", answers({{"%1POWR 1", "%1POWR=ERR3\r"}}));
  auto p = PjlinkProjector::open(projector.address());
  ASSERT_TRUE(p);
  EXPECT_EQ(p.value()->setPower(true)->message,
            "it cannot do that now; it may be warming up, cooling down or off (ERR3)");
  EXPECT_EQ(p.value()->setShutter(true)->message, "it does not know the command (ERR1)");
}

TEST(Pjlink, SaysThatThePasswordIsMissingOrWrong) {
  FakeProjector projector("PJLINK 1 00000001\r",
                          [](const std::string&) { return std::string("PJLINK ERRA\r"); });
  EXPECT_EQ(PjlinkProjector::open(projector.address()).error().message,
            "it wants a password; state the file that has it");
  auto p = PjlinkProjector::open(projector.address("wrong"));
  ASSERT_TRUE(p);
  EXPECT_EQ(p.value()->setPower(true)->message, "the password is wrong");
}

TEST(Pjlink, HostileAnswersAreErrorsInTime) {
  const std::vector<std::pair<std::string, std::string>> cases{
      {std::string(5000, 'x'), "it sends lines without an end"},
      {"HTTP/1.1 200 OK\r", "it greets with \"HTTP/1.1 200 OK\", which is no greeting of PJLink class 1"},
      {"PJLINK 1 \r", "it greets with \"PJLINK 1 \", which is no greeting of PJLink class 1"},
      {"PJLINK 1 zz\r", "it greets with \"PJLINK 1 zz\", which is no greeting of PJLink class 1"},
      {"", "no answer within 0.2 s"}};
  for (const auto& [greeting, expected] : cases) {
    FakeProjector projector(greeting, [](const std::string&) { return std::string(); });
    PjlinkAddress address = projector.address();
    if (greeting.empty()) address.patience = std::chrono::milliseconds(200);
    const auto p = PjlinkProjector::open(address);
    ASSERT_FALSE(p) << greeting;
    EXPECT_EQ(p.error().message, expected);
  }
  FakeProjector closes("PJLINK 0\r", [](const std::string&) { return std::string(); });
  auto p = PjlinkProjector::open(closes.address());
  ASSERT_TRUE(p);
  EXPECT_EQ(p.value()->status().error().message, "it closed the connection");
  EXPECT_TRUE(p.value()->setPower(true).has_value());
}

TEST(Pjlink, AnyBytesGiveAStatusOrAnError) {
  std::mt19937 random(7);
  for (int round = 0; round < 60; ++round) {
    FakeProjector projector("PJLINK 0\r", [&](const std::string& line) {
      std::string answer = line.substr(0, 6) + "=";
      for (unsigned n = random() % 40; n > 0; --n) answer += static_cast<char>(random() % 255 + 1);
      return answer + "\r";
    });
    PjlinkAddress address = projector.address();
    address.patience = std::chrono::milliseconds(100);
    auto p = PjlinkProjector::open(address);
    ASSERT_TRUE(p);
    const auto status = p.value()->status();
    EXPECT_TRUE(status || !status.error().message.empty());
  }
}

TEST(Pjlink, NoSuchHostOrPortIsAnError) {
  EXPECT_TRUE(PjlinkProjector::open({"no-such-host.invalid", 4352, "", std::chrono::milliseconds(200)})
                  .error()
                  .message.starts_with("the host no-such-host.invalid is not known"));
  std::uint16_t port = 0;
  {
    const FakeProjector gone("PJLINK 0\r", [](const std::string&) { return std::string(); });
    port = gone.address().port;
  }
  EXPECT_EQ(PjlinkProjector::open({"127.0.0.1", port, "", std::chrono::milliseconds(500)}).error().message,
            "cannot connect: Connection refused");
}

}  // namespace
}  // namespace stadion
