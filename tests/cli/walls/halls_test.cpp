/// Halls from the command line: simulation, patterns, projectors, conversion.

#include "tests/programs/program.h"

#include <filesystem>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace stadion {
namespace {

/// cylinder-180 with a sixth of its pixels in each direction.
const std::string kSmallHall =
    "pixels 320 200\n"
    "screen round cylinder  centre 0 0 0  radius 3  azimuth -90 90  height 0.5 2.6\n"
    "projector p1 screen round  at 0.2598 -0.15 2.9  turn -60 0  throw 0.79  shift 0 -0.58  display-gamma "
    "2.2\n"
    "projector p2 screen round  at 0 -0.3 2.9  turn 0 0  throw 0.79  shift 0 -0.58  display-gamma 2.2\n"
    "projector p3 screen round  at -0.2598 -0.15 2.9  turn 60 0  throw 0.79  shift 0 -0.58  display-gamma "
    "2.2\n";

nlohmann::json simulated(const std::string& hall, std::vector<std::string> more) {
  std::vector<std::string> words{"walls", hall, "--simulate", "--every", "8", "--json"};
  words.insert(words.end(), more.begin(), more.end());
  const auto r = stadionProgram(words);
  EXPECT_EQ(r.status, 0) << r.err;
  return nlohmann::json::parse(r.out);
}

TEST(ProgramHalls, SimulationFindsNoErrorAndNamesFaults) {
  const TestFolder folder;
  const std::string hall = folder.write("small.walls", kSmallHall);
  const nlohmann::json ideal = simulated(hall, {});
  EXPECT_LT(ideal["geometry_error_px_max"], 0.5);
  EXPECT_LT(ideal["luminance_error_max"], 0.01);
  EXPECT_EQ(ideal["uncovered_fraction"], 0);
  EXPECT_EQ(ideal["suspect"], "");
  const nlohmann::json moved = simulated(hall, {"--moved", "p2", "0.03", "0", "0"});
  EXPECT_EQ(moved["suspect"], "p2");
  EXPECT_EQ(moved["reason"], "its pixels are not where the wall file says");
  const nlohmann::json gamma = simulated(hall, {"--wrong-gamma", "p3", "1.8"});
  EXPECT_EQ(gamma["suspect"], "p3");
  EXPECT_EQ(gamma["reason"], "its light does not follow the curve that the wall file states");
}

TEST(ProgramHalls, PatternsAndPicturesOfTheSimulationAreFiles) {
  const TestFolder folder;
  const std::string out = folder.path() / "out", hall = folder.write("small.walls", kSmallHall);
  for (const char* kind : {"room", "pixels", "blend", "gamma", "bars"}) {
    const auto r = stadionProgram({"walls", hall, "--pattern", "--pattern-kind", kind, "--out", out});
    EXPECT_EQ(r.status, 0) << r.err;
    EXPECT_TRUE(std::filesystem::exists(out + "/p3-left.png")) << kind;
  }
  EXPECT_EQ(stadionProgram({"walls", hall, "--simulate", "--every", "16", "--out", out}).status, 0);
  for (const char* name : {"inside.png", "errors.png", "above.png"})
    EXPECT_TRUE(std::filesystem::exists(out + "/" + name)) << name;
}

TEST(ProgramHalls, WrittenAsMpcdiReadBackAsTheSameHall) {
  const TestFolder folder;
  const std::string mpcdi = folder.path() / "hall.mpcdi", walls = folder.path() / "hall.walls";
  EXPECT_EQ(stadionProgram({"walls", "cylinder-180", "--write", mpcdi}).status, 0);
  EXPECT_EQ(stadionProgram({"walls", mpcdi, "--write", walls}).status, 0);
  const auto plan = stadionProgram({"walls", "cylinder-180"}).out,
             again = stadionProgram({"walls", walls}).out;
  EXPECT_EQ(plan.substr(0, plan.find("threads:")), again.substr(0, again.find("threads:")));
}

TEST(ProgramHalls, AreCheckedAsShowsAre) {
  const TestFolder folder;
  const auto good = stadionProgram({"check", folder.write("small.walls", kSmallHall)});
  EXPECT_EQ(good.status, 0) << good.err;
  EXPECT_NE(good.out.find("small.walls: ok"), std::string::npos) << good.out;
  const auto wrong = stadionProgram(
      {"check", folder.write("wrong.walls", "projector p screen a pixels 9 9 at 0 0 1 turn 0 0 throw 1\n")});
  EXPECT_EQ(wrong.status, 2);
  EXPECT_NE(wrong.out.find("wrong.walls:1:20: error: there is no screen \"a\""), std::string::npos)
      << wrong.out;
}

TEST(ProgramHalls, WrongRequestsEndWithTwo) {
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"walls", "cave4", "--simulate"},
        {"walls", "cylinder-180", "--simulate", "--moved", "nosuch", "1", "2", "3"},
        {"walls", "cylinder-180", "--simulate", "--moved", "p1", "1", "2", "far"},
        {"walls", "cylinder-180", "--simulate", "--wrong-gamma", "p1", "99"},
        {"projectors", "cylinder-180", "on"},
        {"projectors", "cylinder-180", "on", "nosuch"}}) {
    const auto r = stadionProgram(words);
    EXPECT_EQ(r.status, 2) << words[0] << ' ' << words[2];
    EXPECT_FALSE(r.err.empty());
  }
}

}  // namespace
}  // namespace stadion
