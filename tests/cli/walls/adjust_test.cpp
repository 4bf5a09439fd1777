/// `stadion walls FILE --adjust`: by commands, and by keys in windows.

#include "engine/base/plain_file.h"
#include "pipeline/picture/picture.h"
#include "tests/programs/desk.h"

#include <filesystem>
#include <fmt/format.h>
#include <gtest/gtest.h>

namespace stadion {
namespace {

/// Two pinned projectors on one screen, in windows side by side.
std::string pinnedHall(const std::string& output) {
  return "visitor 0 0 1.7 within 0.2\n"
         "screen front plane  lower-left -2 2 0.7  lower-right 2 2 0.7  upper-left -2 2 2.7  # measured\n"
         "projector one  screen front  pixels 200 160  pins 0 0  1.6 0  1.6 1  0 1  # left\n"
         "projector two  screen front  pixels 200 160  pins -0.6 0  1 0  1 1  -0.6 1\n" +
         output;
}

std::string textIn(const std::string& path) {
  const auto text = readPlainFile(path, 1 << 20);
  return text ? text.value() : std::string();
}

ProgramResult adjustedBy(const std::string& commands, const std::string& walls,
                         std::vector<std::string> more = {}) {
  const TestFolder folder;
  ProgramRun run;
  run.words = {"sh",
               "-c",
               "commands=$1; shift; exec \"$@\" < \"$commands\"",
               "sh",
               folder.write("commands", commands),
               stadionPath(),
               "walls",
               walls,
               "--adjust",
               "--commands"};
  run.words.insert(run.words.end(), more.begin(), more.end());
  return runProgram(run);
}

TEST(ProgramAdjust, CommandsChangeTheFileAndAFailedOneEndsWithTwo) {
  const TestFolder folder;
  const std::string walls = folder.write("hall.walls", pinnedHall(""));
  const std::string out = folder.path() / "out";
  const auto done = adjustedBy("right 2\nprojector two\nedge left\nright 10\nundo\nredo\nshow\nsave\nquit\n",
                               walls, {"--out", out});
  EXPECT_EQ(done.status, 0) << done.err;
  EXPECT_NE(done.out.find("two: edge left at 0.05 (10.0 pixels); saved\n"), std::string::npos) << done.out;
  std::string expected = pinnedHall("");
  expected.replace(expected.find("pins 0 0"), 8, "pins 0.01 0");
  expected.replace(expected.find("-0.6 1\n"), 7, "-0.6 1  edge-left 0.05\n");
  EXPECT_EQ(textIn(walls), expected);
  EXPECT_TRUE(std::filesystem::exists(out + "/two-left.png"));
  EXPECT_EQ(adjustedBy("right 2\n", walls).status, 2) << "not saved";
  EXPECT_EQ(adjustedBy("lift\nquit\n", walls).status, 2);
  EXPECT_EQ(textIn(walls), expected);
}

class ProgramAdjustWindows : public testing::Test {
protected:
  void SetUp() override {
    display_ = Display::open({"640x480x24"});
    if (!display_) GTEST_SKIP() << "needs Xvfb, xdotool and import: apt-get install xvfb xdotool imagemagick";
  }
  std::unique_ptr<Display> display_;
};

TEST_F(ProgramAdjustWindows, KeysMoveAPinOnTheScreenAndWriteItBack) {
  const TestFolder folder;
  const std::string walls = folder.write("hall.walls", pinnedHall("output one  rectangle 20 20 200 160\n"
                                                                  "output two  rectangle 240 20 200 160\n"));
  RunningProgram program(onDisplay(*display_, {"walls", walls, "--adjust"}));
  ASSERT_TRUE(program.says("the walls are shown"));
  const std::string before = folder.path() / "before.png", after = folder.path() / "after.png";
  ASSERT_TRUE(display_->photograph(before));
  const auto reached = [&](const std::string& state) {
    return program.waitUntil([&] { return program.out().find(state) != std::string::npos; });
  };
  display_->hands({"mousemove", "100", "100", "key", "shift+Right"});
  EXPECT_TRUE(reached("one: pin 1 (upper left) at 0.05 0 (10.0 0.0 pixels); moved [not saved]"))
      << program.out();
  display_->hands({"key", "ctrl+Down"});
  EXPECT_TRUE(reached("at 0.05 0.000625 (10.0 0.1 pixels)")) << program.out();
  display_->hands({"key", "u", "key", "Tab", "key", "7", "key", "Left"});
  EXPECT_TRUE(reached("two: edge right at 0.005 (1.0 pixels); moved [not saved]")) << program.out();
  display_->hands({"key", "q"});
  EXPECT_TRUE(reached("changes are not saved")) << program.out();
  ASSERT_TRUE(display_->photograph(after));
  display_->hands({"key", "s"});
  EXPECT_TRUE(reached("; saved\n")) << program.out();
  display_->hands({"key", "q"});
  EXPECT_EQ(program.status(), 0) << program.err();
  EXPECT_NE(textIn(walls).find("pins 0.05 0  1.6 0  1.6 1  0 1  # left\n"), std::string::npos)
      << textIn(walls);
  EXPECT_NE(textIn(walls).find("-0.6 1  edge-right 0.005\n"), std::string::npos) << textIn(walls);
  const auto a = readPng(before), b = readPng(after);
  ASSERT_TRUE(a && b);
  EXPECT_NE(imageHash(a.value()), imageHash(b.value()));
}

}  // namespace
}  // namespace stadion
