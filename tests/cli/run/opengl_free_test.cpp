/// A program whose walls the processors draw loads no OpenGL for its windows.

#include "tests/programs/desk.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <set>
#include <sstream>

namespace stadion {
namespace {

/// The OpenGL libraries, and those behind them, that a process has loaded.
std::set<std::string> openGlOf(pid_t process) {
  std::set<std::string> found;
  std::istringstream maps(fileContent(fmt::format("/proc/{}/maps", process)));
  for (std::string line; std::getline(maps, line);)
    for (const char* name : {"libGL", "libEGL", "libOSMesa", "libgallium", "libLLVM", "libglapi", "_dri.so"})
      if (line.find(name) != std::string::npos) found.insert(line.substr(line.find('/')));
  return found;
}

class ProgramWithoutOpenGl : public testing::Test {
protected:
  void SetUp() override {
    display_ = Display::open({"640x480x24"});
    if (!display_) GTEST_SKIP() << "needs Xvfb, xdotool and import: apt-get install xvfb xdotool imagemagick";
  }

  /// What the command has loaded once it shows pictures.
  std::set<std::string> loadedBy(std::vector<std::string> words, const char* sign) {
    RunningProgram program(onDisplay(*display_, std::move(words)));
    if (!program.says(sign)) return {"nothing was shown"};
    display_->hands({"mousemove", "40", "30"});
    std::set<std::string> found = openGlOf(program.pid());
    display_->hands({"key", "Escape"});
    EXPECT_EQ(program.status(), 0) << program.err();
    return found;
  }

  std::vector<std::string> showing(const char* command, const char* renderer) {
    std::vector<std::string> words{
        command,        folder_.write("still.evs", "object( file=football.3ds, position=\"0, 3, 1.5\" )\n"),
        "--asset-root", assetFolder(),
        "--walls",      walls_,
        "--renderer",   renderer,
        "--no-sound"};
    if (std::string(command) == "run") words.emplace_back("--display");
    return words;
  }

  TestFolder folder_;
  std::unique_ptr<Display> display_;
  std::string walls_ =
      folder_.write("one.walls", "wall one  lower-left -1 2 0  lower-right 1 2 0  upper-left -1 2 2\n"
                                 "output one  rectangle 20 10 200 150\n");
};

using Libraries = std::set<std::string>;

TEST_F(ProgramWithoutOpenGl, WindowsLoadNoLibraryOfItWhereTheProcessorsDraw) {
  EXPECT_EQ(loadedBy({"walls", walls_, "--pattern"}, "the walls are shown"), Libraries{});
  EXPECT_EQ(loadedBy(showing("run", "cpu"), "the walls are shown"), Libraries{});
  EXPECT_EQ(loadedBy(showing("view", "cpu"), "playing "), Libraries{});
}

TEST_F(ProgramWithoutOpenGl, WindowsHaveItWhereItDraws) {
  EXPECT_GT(loadedBy(showing("run", "gl"), "the walls are shown").size(), 2u);
}

}  // namespace
}  // namespace stadion
