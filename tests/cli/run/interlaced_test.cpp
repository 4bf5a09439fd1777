/// Interlaced pictures on a display in memory: the monitor's even rows are for the left eye, wherever the
/// window is.

#include "pipeline/picture/picture.h"
#include "tests/programs/desk.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <gtest/gtest.h>

namespace stadion {
namespace {

constexpr std::uint32_t kAcross = 96;

/// The test pattern of one wall, and what should be seen of it.
class ProgramInterlaced : public testing::Test {
protected:
  void SetUp() override {
    display_ = Display::open({"640x480x24"});
    if (!display_) GTEST_SKIP() << "needs Xvfb, xdotool and import: apt-get install xvfb xdotool imagemagick";
  }

  std::string walls(int y, std::uint32_t height, const std::string& fields) {
    return folder_.write("one.walls",
                         fmt::format("wall one  lower-left -1 2 0  lower-right 1 2 0  upper-left -1 2 2\n"
                                     "output one  rectangle 30 {} {} {}  {}\n",
                                     y, kAcross, height, fields));
  }

  Picture screen() {
    const std::string file = folder_.path() / fmt::format("{}.png", ++shots_);
    EXPECT_TRUE(display_->photograph(file));
    const auto picture = readPng(file);
    return picture ? picture.value() : Picture();
  }

  /// What a window there shows.
  Picture window(int y, std::uint32_t height) {
    const Picture all = screen();
    Picture part(kAcross, height);
    for (std::uint32_t v = 0; v < height && !all.empty(); ++v)
      std::copy_n(all.at(30, static_cast<std::uint32_t>(y) + v), std::size_t{kAcross} * 4, part.at(0, v));
    return part;
  }

  /// Rows of both, one after the other; the top one is of `even`.
  static Picture mixed(const Picture& even, const Picture& odd) {
    Picture mix = even;
    for (std::uint32_t v = 1; v < mix.height; v += 2)
      std::copy_n(odd.at(0, v), std::size_t{kAcross} * 4, mix.at(0, v));
    return mix;
  }

  void move(int y) {
    display_->hands({"search", "--sync", "--name", "Stadion: one", "windowmove", "30", std::to_string(y)});
  }

  /// Moves a window of that shape about and looks at its rows. Returns what is for the left and the right
  /// eye.
  std::array<Picture, 2> expectRows(std::uint32_t height, const std::string& fields,
                                    std::initializer_list<int> places = {31, 0}) {
    RunningProgram program(
        onDisplay(*display_, {"walls", walls(40, height, fields), "--pattern", "--stereo", "interlaced"}));
    EXPECT_TRUE(program.says("the walls are shown"));
    const Picture at40 = window(40, height);
    move(41);
    Picture at41;
    EXPECT_TRUE(program.waitUntil([&] { return (at41 = window(41, height)).rgba != at40.rgba; }));
    const Picture left = mixed(at40, at41), right = mixed(at41, at40);
    EXPECT_NE(imageHash(left), imageHash(right));
    int last = 41;
    for (const int y : places) {
      move(last = y);
      const Picture wanted = y % 2 == 0 ? mixed(left, right) : mixed(right, left);
      EXPECT_TRUE(program.waitUntil([&] { return window(y, height).rgba == wanted.rgba; }))
          << fields << " at " << y;
    }
    display_->hands({"mousemove", "40", std::to_string(last + 10), "key", "Escape"});
    EXPECT_EQ(program.status(), 0) << program.err();
    return {left, right};
  }

  std::unique_ptr<Display> display_;
  TestFolder folder_;
  int shots_ = 0;
};

TEST_F(ProgramInterlaced, TheEvenRowsOfTheMonitorAreForTheLeftEyeWhereverTheWindowIs) {
  const ProgramResult written =
      stadionProgram({"walls", walls(40, 64, ""), "--pattern", "--out", folder_.path(), "--size", "96x64"});
  ASSERT_EQ(written.status, 0) << written.err;
  const auto left = readPng(folder_.path() / "one-left.png"),
             right = readPng(folder_.path() / "one-right.png");
  ASSERT_TRUE(left && right);
  const auto rows = expectRows(64, "", {31, 0, 7, 200});
  EXPECT_EQ(rows[0].rgba, left.value().rgba);
  EXPECT_EQ(rows[1].rgba, right.value().rgba);
  const auto swapped = expectRows(64, "swap-eyes");
  EXPECT_EQ(swapped[0].rgba, rows[1].rgba);
  EXPECT_EQ(swapped[1].rgba, rows[0].rgba);
}

TEST_F(ProgramInterlaced, SoItIsOfPicturesThatAreMirroredTurnedAndWarpedAndOfOddHeight) {
  const auto plain = expectRows(65, "");
  const auto mirrored = expectRows(65, "flip-v rotate 180");
  for (std::size_t eye = 0; eye < 2; ++eye)
    for (std::uint32_t v = 0; v < 65; ++v)
      for (std::uint32_t u = 0; u < kAcross; ++u)
        ASSERT_TRUE(
            std::equal(plain[eye].at(u, v), plain[eye].at(u, v) + 3, mirrored[eye].at(kAcross - 1 - u, v)));
  expectRows(64, "warp 0 0.1  1 0  0.9 1  0.1 0.9");
}

}  // namespace
}  // namespace stadion
