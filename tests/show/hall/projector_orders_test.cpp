/// Orders to the projectors of a hall, some of which do not answer.

#include "show/hall/projector_orders.h"
#include "tests/pipeline/projector_control/fake_projector.h"

#include <fstream>
#include <gtest/gtest.h>
#include <mutex>

namespace stadion {
namespace {

using test::FakeProjector;

constexpr std::chrono::milliseconds kPatience{1000};

WallFile hallWith(std::string text) {
  Diagnostics findings;
  auto hall = parseWalls("unit m\nwall a lower-left -1 1 0 lower-right 1 1 0 upper-left -1 1 2\n"
                         "wall b lower-left -1 -1 0 lower-right -1 1 0 upper-left -1 -1 2\n" +
                             text,
                         testing::TempDir() + "/hall.walls", findings);
  EXPECT_TRUE(hall) << (findings.all().empty() ? "" : findings.all()[0].message);
  return hall ? *hall : WallFile();
}

std::string control(const std::string& name, const PjlinkAddress& address, const std::string& more = {}) {
  return "control " + name + " pjlink " + address.host + " port " + std::to_string(address.port) + more +
         "\n";
}

TEST(ProjectorOrders, EachProjectorGetsTheOrderAndReportsItsState) {
  std::mutex mutex;
  std::vector<std::string> orders;
  const auto answer = [&](const std::string& line) -> std::string {
    const std::lock_guard lock(mutex);
    if (line.find('?') == std::string::npos) orders.push_back(line);
    if (line.ends_with("POWR ?")) return "%1POWR=1\r";
    if (line.ends_with("AVMT ?")) return "%1AVMT=31\r";
    return line.find('?') == std::string::npos ? "%1AVMT=OK\r" : line.substr(0, 6) + "=ERR3\r";
  };
  const FakeProjector good("PJLINK 0\r", answer), secret("PJLINK 1 0badcafe\r", answer);
  std::ofstream(testing::TempDir() + "/password.txt") << "sesame\n";
  const WallFile hall =
      hallWith(control("b", secret.address(), " password password.txt") + control("a", good.address()));
  Diagnostics findings;
  const auto all = orderProjectors(hall, ProjectorOrder::Shut, {}, kPatience, findings);
  ASSERT_TRUE(all);
  ASSERT_EQ(all->size(), 2U);
  for (const OrderedProjector& p : *all) {
    ASSERT_TRUE(p.status) << p.name << ": " << p.error;
    EXPECT_TRUE(p.status->shut);
    EXPECT_EQ(p.status->power, PjlinkStatus::Power::On);
  }
  EXPECT_EQ((*all)[0].name, "a");
  EXPECT_EQ(orders.size(), 2U);
}

TEST(ProjectorOrders, ASilentProjectorDoesNotHoldUpTheOthers) {
  const FakeProjector silent("", [](const std::string&) { return std::string(); });
  const FakeProjector good("PJLINK 0\r", [](const std::string& line) {
    return line.ends_with("POWR ?") ? "%1POWR=0\r" : line.substr(0, 6) + "=ERR3\r";
  });
  const WallFile hall = hallWith(control("a", silent.address()) + control("b", good.address()));
  Diagnostics findings;
  const auto all =
      orderProjectors(hall, ProjectorOrder::Status, {}, std::chrono::milliseconds(200), findings);
  ASSERT_TRUE(all);
  EXPECT_EQ((*all)[0].error, "no answer within 0.2 s");
  ASSERT_TRUE((*all)[1].status);
  EXPECT_EQ((*all)[1].status->power, PjlinkStatus::Power::Off);
}

TEST(ProjectorOrders, ANameWithoutControlAndAnEmptyPasswordFileAreErrors) {
  Diagnostics findings;
  EXPECT_FALSE(orderProjectors(hallWith(""), ProjectorOrder::On, {}, kPatience, findings));
  EXPECT_TRUE(findings.hasErrors());
  const FakeProjector good("PJLINK 0\r", [](const std::string&) { return std::string(); });
  std::ofstream(testing::TempDir() + "/empty.txt") << "\n";
  const WallFile hall = hallWith(control("a", good.address(), " password empty.txt"));
  Diagnostics others;
  EXPECT_FALSE(orderProjectors(hall, ProjectorOrder::On, {"b"}, kPatience, others));
  EXPECT_NE(others.all()[0].message.find("add a line such as: control b pjlink HOST"), std::string::npos);
  Diagnostics none;
  const auto all = orderProjectors(hall, ProjectorOrder::On, {"a"}, kPatience, none);
  ASSERT_TRUE(all);
  EXPECT_NE((*all)[0].error.find("must be the password"), std::string::npos);
}

TEST(ProjectorOrders, ControlLinesAreReadAndWrittenBack) {
  const WallFile hall =
      hallWith("control a pjlink 10.0.0.7\ncontrol b pjlink beamer.local port 4353 password secret.txt\n");
  ASSERT_TRUE(hall.walls[0].control && hall.walls[1].control);
  EXPECT_EQ(hall.walls[0].control->port, 4352);
  Diagnostics findings;
  const auto again = parseWalls(formatWalls(hall), "again.walls", findings);
  ASSERT_TRUE(again);
  EXPECT_EQ(again->walls[0].control, hall.walls[0].control);
  EXPECT_EQ(again->walls[1].control, hall.walls[1].control);
  for (const char* wrong : {"control c pjlink host\n", "control a artnet host\n", "control a pjlink\n",
                            "control a pjlink host port 0\n", "control a pjlink x\ncontrol a pjlink y\n"}) {
    Diagnostics errors;
    EXPECT_FALSE(parseWalls(
        "wall a lower-left -1 1 0 lower-right 1 1 0 upper-left -1 1 2\n" + std::string(wrong), "w", errors))
        << wrong;
    EXPECT_EQ(errors.all().size(), 1U) << wrong;
  }
}

}  // namespace
}  // namespace stadion
