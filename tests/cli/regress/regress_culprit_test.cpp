/// `stadion regress` names the node, wall or stage that became dearer.

#include "tests/cli/regress/small_suite.h"

#include <gtest/gtest.h>

#include <regex>
#include <unistd.h>

namespace stadion {
namespace {

/// A "build" in which something costs more than in ours.
std::string spoilt(const TestFolder& folder, const std::string& planted) {
  const std::string path =
      folder.write("stadion", "#!/bin/sh\nfor word; do [ \"$word\" = --spans ] && set -- \"$@\" --plant " +
                                  planted + "; done\nexec " + stadionPath() + " \"$@\"\n");
  std::filesystem::permissions(path, std::filesystem::perms::owner_all);
  return path;
}

std::string crowdSuite(const TestFolder& folder, const std::string& compare) {
  return folder.write("crowd.suite",
                      "stadion-suite 1\nsize 32x24\nstereo off\ncase crowd\n  show " STADION_SOURCE_DIR
                      "/scripts/crowd.evs\n  walls " STADION_SOURCE_DIR
                      "/scripts/suites/two.walls\n  input none\n  frames 40\n  rounds 12\n  compare " +
                          compare + "\n");
}

// Not five percent but several times as much, so that the test does not depend on the machine.
TEST(ProgramFullRegress, ANodeThatBecameDearerIsNamedByItsTime) {
  const TestFolder folder;
  const ProgramResult r = regress({crowdSuite(folder, "times"), "--against", stadionPath(), "--stadion",
                                   spoilt(folder, "simulate:lane_07=2000000")});
  EXPECT_EQ(r.status, 1) << r.out << r.err;
  EXPECT_TRUE(std::regex_search(r.out, std::regex("moved: lane_07 \\(.*crowd.evs:[0-9]+\\) in app")))
      << r.out;
}

/// The typical frame is the same. Three kinds, so that work, sleep, a node and a wall are among them.
TEST(ProgramFullRegress, HitchesAreFoundAndNamedWithTheirFrames) {
  const struct {
    const char *planted, *frames, *moved;
  } kinds[] = {{"simulate:lane_07=sleep20ms/10", "frames 0, 10, 20, 30 longer by 2",
                "moved: lane_07 \\(.*crowd.evs:[0-9]+\\) in app"},
               {"draw:west=20ms/20+3", "frames 3, 23 longer by 2", "moved: draw of wall west"},
               {"frame:=sleep20ms/100+9", "frame 9 longer by 2", "moved: frame, between the stages"}};
  for (const auto& kind : kinds) {
    const TestFolder folder;
    const ProgramResult r = regress(
        {crowdSuite(folder, "times"), "--against", stadionPath(), "--stadion", spoilt(folder, kind.planted)});
    EXPECT_EQ(r.status, 1) << kind.planted << r.out << r.err;
    EXPECT_NE(r.out.find(kind.frames), std::string::npos) << r.out;
    EXPECT_TRUE(std::regex_search(r.out, std::regex(kind.moved))) << r.out;
    EXPECT_NE(r.out.find("again in 12 more rounds"), std::string::npos) << r.out;
  }
}

TEST(ProgramFullRegress, AWallWhoseCullingBecameDearerIsNamedByItsInstructions) {
  if (runProgram({{"valgrind", "--version"}}).status != 0) GTEST_SKIP() << "there is no valgrind";
  const TestFolder folder;
  const ProgramResult r = regress({crowdSuite(folder, "instructions"), "--instructions", "--against",
                                   stadionPath(), "--stadion", spoilt(folder, "cull:west=20000")});
  EXPECT_EQ(r.status, 1) << r.out << r.err;
  EXPECT_NE(r.out.find("moved: cull of wall west"), std::string::npos) << r.out;
  EXPECT_NE(r.out.find("4 comparisons passed, 1 failed"), std::string::npos) << r.out;
}

TEST(ProgramFullRegress, AgainstABaselineTheNodeThatMovedIsNamedToo) {
  if (runProgram({{"valgrind", "--version"}}).status != 0) GTEST_SKIP() << "there is no valgrind";
  const TestFolder folder;
  const std::string suite = crowdSuite(folder, "instructions");
  ASSERT_EQ(regress({suite, "--instructions", "--update"}).status, 0);
  const ProgramResult r =
      regress({suite, "--instructions", "--stadion", spoilt(folder, "simulate:lane_07=20000")});
  EXPECT_EQ(r.status, 1) << r.out << r.err;
  EXPECT_TRUE(std::regex_search(r.out, std::regex("moved: lane_07 \\(.*crowd.evs:[0-9]+\\) in app")))
      << r.out;
}

TEST(ProgramFullRegress, AgainstABaselinesTimesTheNodeThatMovedIsNamedToo) {
  const TestFolder folder;
  const std::string suite = crowdSuite(folder, "times");
  ASSERT_EQ(regress({suite, "--update"}).status, 0);
  const ProgramResult r = regress({suite, "--stadion", spoilt(folder, "simulate:lane_07=2000000")});
  EXPECT_EQ(r.status, 1) << r.out << r.err;
  EXPECT_TRUE(std::regex_search(r.out, std::regex("moved: lane_07 \\(.*crowd.evs:[0-9]+\\) in app")))
      << r.out;
}

TEST(ProgramFullRegress, AProgramMayHaveAnyNameWhereInstructionsAreCounted) {
  if (runProgram({{"valgrind", "--version"}}).status != 0) GTEST_SKIP() << "there is no valgrind";
  const TestFolder folder;
  const std::string other = folder.path() / "before the change", link = folder.path() / "now";
  std::filesystem::copy_file(stadionPath(), other);
  std::filesystem::create_symlink(stadionPath(), link);
  const ProgramResult r =
      regress({crowdSuite(folder, "instructions"), "--instructions", "--against", other, "--stadion", link});
  EXPECT_EQ(r.status, 0) << r.out << r.err;
  EXPECT_NE(r.out.find("instructions of app"), std::string::npos) << r.out;
}

}  // namespace
}  // namespace stadion
