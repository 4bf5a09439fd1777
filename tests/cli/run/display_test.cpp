/// Walls on real outputs: two screens of a display in memory, photographed.

#include "pipeline/picture/picture.h"
#include "tests/programs/desk.h"

#include <array>
#include <cmath>
#include <fmt/format.h>
#include <functional>
#include <gtest/gtest.h>
#include <optional>
#include <set>

namespace stadion {
namespace {

constexpr std::uint32_t kWidth = 240, kHeight = 160;

/// Two walls of 3 x 2 m in a corner, one on each screen.
std::string wallFile(const std::string& display, const std::string& rectangle, const std::string& fields) {
  return "wall one  lower-left -2 2 0.5  lower-right 1 2 0.5  upper-left -2 2 2.5\n"
         "wall two  lower-left 1 2 0.5  lower-right 1 -1 0.5  upper-left 1 2 2.5\n" +
         fmt::format("output one  screen {0}.0  rectangle 30 20 {1}  {2}\n"
                     "output two  screen {0}.1  rectangle 50 40 {1}  {2}\n",
                     display, rectangle, fields);
}

Picture cut(const Picture& from, std::uint32_t x, std::uint32_t y, std::uint32_t width,
            std::uint32_t height) {
  Picture part(width, height);
  for (std::uint32_t v = 0; v < height; ++v)
    std::copy_n(from.at(x, y + v), std::size_t{width} * 4, part.at(0, v));
  return part;
}

/// What each pixel of a picture of that size shows of `from`.
Picture changed(const Picture& from, std::uint32_t width, std::uint32_t height,
                const std::function<std::array<std::uint32_t, 2>(std::uint32_t, std::uint32_t)>& source) {
  Picture to(width, height);
  for (std::uint32_t y = 0; y < height; ++y)
    for (std::uint32_t x = 0; x < width; ++x) {
      const auto [u, v] = source(x, y);
      std::copy_n(from.at(u, v), 4, to.at(x, y));
    }
  return to;
}

std::size_t coloursIn(const Picture& p) {
  std::set<std::array<std::uint8_t, 3>> colours;
  for (std::size_t i = 0; i + 3 < p.rgba.size(); i += 4)
    colours.insert({p.rgba[i], p.rgba[i + 1], p.rgba[i + 2]});
  return colours.size();
}

struct ShownWindow {
  Picture one, two;
};

/// What stands on the two screens once the program says that the walls are shown.
std::optional<ShownWindow> shownBy(const Display& display, std::vector<std::string> arguments,
                                   std::uint32_t width, std::uint32_t height) {
  const TestFolder folder;
  RunningProgram program(onDisplay(display, std::move(arguments)));
  if (!program.says("the walls are shown")) return {};
  const std::string first = folder.path() / "0.png", second = folder.path() / "1.png";
  if (!display.photograph(first, 0) || !display.photograph(second, 1)) return {};
  display.hands({"mousemove", "40", "30", "key", "Escape"});
  EXPECT_EQ(program.status(), 0) << program.err();
  const auto a = readPng(first), b = readPng(second);
  if (!a || !b) return {};
  return ShownWindow{cut(a.value(), 30, 20, width, height), cut(b.value(), 50, 40, width, height)};
}

class ProgramDisplay : public testing::Test {
protected:
  void SetUp() override {
    display_ = Display::open({"640x480x24", "640x480x24"});
    if (!display_) GTEST_SKIP() << "needs Xvfb, xdotool and import: apt-get install xvfb xdotool imagemagick";
  }

  /// The test pattern, or a show that stands still, on outputs with these fields.
  std::optional<ShownWindow> shown(const std::string& fields, bool across = false) {
    const std::uint32_t w = across ? kHeight : kWidth, h = across ? kWidth : kHeight;
    const std::string walls =
        folder_.write("two.walls", wallFile(display_->name(), fmt::format("{} {}", w, h), fields));
    if (show_.empty()) return shownBy(*display_, {"walls", walls, "--pattern"}, w, h);
    return shownBy(
        *display_,
        {"run", show_, "--asset-root", assetFolder(), "--walls", walls, "--look", look_, "--display"}, w, h);
  }

  void expectChanges() {
    const auto plain = shown("");
    ASSERT_TRUE(plain);
    EXPECT_GT(coloursIn(plain->one), 4u);
    EXPECT_NE(imageHash(plain->one), imageHash(plain->two));
    const auto mirrored = shown("flip-h");
    const auto turned = shown("flip-v rotate 180");  // which is the same
    const auto quarter = shown("rotate 90", true);
    ASSERT_TRUE(mirrored && turned && quarter);
    const auto leftRight = [](std::uint32_t x, std::uint32_t y) { return std::array{kWidth - 1 - x, y}; };
    EXPECT_EQ(mirrored->one.rgba, changed(plain->one, kWidth, kHeight, leftRight).rgba);
    EXPECT_EQ(mirrored->two.rgba, changed(plain->two, kWidth, kHeight, leftRight).rgba);
    EXPECT_EQ(turned->one.rgba, mirrored->one.rgba);
    const auto clockwise = [](std::uint32_t x, std::uint32_t y) { return std::array{y, kHeight - 1 - x}; };
    EXPECT_EQ(quarter->two.rgba, changed(plain->two, kHeight, kWidth, clockwise).rgba);
  }

  TestFolder folder_;
  std::unique_ptr<Display> display_;
  std::string show_, look_ = "plain";
};
class ProgramFullDisplay : public ProgramDisplay {};

TEST_F(ProgramDisplay, ThePatternIsMirroredAndTurnedPixelByPixelOnTwoScreens) {
  expectChanges();
}

constexpr const char* kStillShow = "object( file=football.3ds, position=\"0.5, 3, 1.5\", scale=4 )\n"
                                   "object( file=plane.3ds )\n";

TEST_F(ProgramDisplay, AShowIsMirroredAndTurnedPixelByPixelOnTwoScreens) {
  show_ = folder_.write("still.evs", kStillShow);
  expectChanges();
}

TEST_F(ProgramFullDisplay, AShowInTheFullLookIsMirroredAndTurnedPixelByPixelOnTwoScreens) {
  show_ = folder_.write("still.evs", kStillShow), look_ = "full";
  expectChanges();
}

TEST_F(ProgramDisplay, TheNextGroupIsAKeyInAWindowAndTheShowRestarts) {
  const std::string walls =
      folder_.write("two.walls", wallFile(display_->name(), fmt::format("{} {}", kWidth, kHeight), ""));
  const std::string show = folder_.write("ball.evs", "object( file=football.3ds, position=\"0, 3, 1.5\" )\n");
  const std::string record = folder_.path() / "visit.input";
  RunningProgram program(
      onDisplay(*display_, {"run", show, "--asset-root", assetFolder(), "--walls", walls, "--look", "plain",
                            "--display", "--no-sound", "--record-input", record}));
  ASSERT_TRUE(program.says("the walls are shown"));
  display_->hands({"mousemove", "40", "30", "key", "n"});
  ASSERT_TRUE(program.says("group 2 begins: reset in "));
  display_->hands({"key", "n"});
  ASSERT_TRUE(program.says("group 3 begins: reset in "));
  const std::string seen = folder_.path() / "seen.png";
  ASSERT_TRUE(display_->photograph(seen, 0));
  const auto picture = readPng(seen);
  ASSERT_TRUE(picture);
  EXPECT_GT(coloursIn(cut(picture.value(), 30, 20, kWidth, kHeight)), 4u);
  display_->hands({"key", "Escape"});
  EXPECT_EQ(program.status(), 0) << program.err();
  for (const char* log : {"visit.input", "visit-2.input", "visit-3.input"})
    EXPECT_FALSE(fileContent(folder_.path() / log).empty()) << log;
}

TEST_F(ProgramDisplay, TheFrameBudgetIsShownAndHiddenByAKey) {
  const std::string walls =
      folder_.write("two.walls", wallFile(display_->name(), fmt::format("{} {}", kWidth, kHeight), ""));
  const std::string show = folder_.write("still.evs", kStillShow);
  const std::vector<std::string> words{"run", show,     "--asset-root", assetFolder(), "--walls",
                                       walls, "--look", "plain",        "--display",   "--no-sound"};
  const auto plain = shownBy(*display_, words, kWidth, kHeight);
  ASSERT_TRUE(plain);
  std::vector<std::string> withBudget = words;
  withBudget.push_back("--hud");
  RunningProgram program(onDisplay(*display_, withBudget));
  ASSERT_TRUE(program.says("the walls are shown"));
  const std::string seen = folder_.path() / "seen.png";
  const auto isPlain = [&]() -> std::optional<bool> {
    if (!display_->photograph(seen, 0)) return std::nullopt;
    const auto picture = readPng(seen);
    if (!picture) return std::nullopt;
    return cut(picture.value(), 30, 20, kWidth, kHeight).rgba == plain->one.rgba;
  };
  const auto becomes = [&](bool wanted) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(2);
    while (isPlain() != wanted) {
      if (std::chrono::steady_clock::now() > end) return false;
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
    return true;
  };
  ASSERT_TRUE(becomes(false));
  display_->hands({"mousemove", "40", "30", "key", "F2"});
  EXPECT_TRUE(becomes(true));
  display_->hands({"key", "F2"});
  EXPECT_TRUE(becomes(false));
  display_->hands({"key", "Escape"});
  EXPECT_EQ(program.status(), 0) << program.err();
}

// Xlib's way is to end the process there and then.
TEST_F(ProgramDisplay, AKilledWindowOrServerEndsTheRunAsItShould) {
  const std::string walls =
      folder_.write("two.walls", wallFile(display_->name(), fmt::format("{} {}", kWidth, kHeight), ""));
  const std::string show = folder_.write("ball.evs", "object( file=football.3ds, position=\"0, 3, 1.5\" )\n");
  const std::vector<std::string> ways[] = {{"windowkill"}, {"windowclose"}, {}};  // {}: the whole server
  for (const std::vector<std::string>& way : ways) {
    const std::string record = folder_.path() / fmt::format("visit{}.input", way.empty() ? "" : way[0]);
    RunningProgram program(
        onDisplay(*display_, {"run", show, "--asset-root", assetFolder(), "--walls", walls, "--look", "plain",
                              "--display", "--no-sound", "--record-input", record}));
    ASSERT_TRUE(program.says("the walls are shown"));
    if (way.empty())
      display_->breakDown();
    else
      display_->hands({"search", "--sync", "--name", "Stadion: one", way[0]});
    EXPECT_EQ(program.status(), 3) << program.err();
    EXPECT_NE(program.err().find("stadion: the connection to the display is lost: "), std::string::npos)
        << program.err();
    EXPECT_NE(program.out().find("state hash"), std::string::npos) << "the summary: " << program.out();
    EXPECT_FALSE(fileContent(record).empty());
  }
}

TEST_F(ProgramDisplay, BrightnessAndGammaActPerChannel) {
  const auto plain = shown(""), dim = shown("brightness 0.5 1 1"), bright = shown("gamma 1 1 2");
  ASSERT_TRUE(plain && dim && bright);
  for (std::size_t i = 0; i < plain->one.rgba.size(); i += 4) {
    const std::uint8_t *p = &plain->one.rgba[i], *d = &dim->one.rgba[i], *b = &bright->one.rgba[i];
    ASSERT_NEAR(d[0], p[0] * 0.7297, 1.0);  // 0.5 to the power of 1 / 2.2
    ASSERT_EQ(d[1], p[1]);
    ASSERT_EQ(b[0], p[0]);
    ASSERT_NEAR(b[2], 255 * std::sqrt(p[2] / 255.0), 1.0);
  }
}

TEST_F(ProgramDisplay, FourCornersMayBePulledIn) {
  const auto warped = shown("warp 0.25 0.25  0.75 0.25  0.75 0.75  0.25 0.75");
  ASSERT_TRUE(warped);
  const auto black = [&](std::uint32_t x, std::uint32_t y) {
    const std::uint8_t* p = warped->one.at(x, y);
    return p[0] == 0 && p[1] == 0 && p[2] == 0;
  };
  EXPECT_TRUE(black(10, 10) && black(kWidth - 10, kHeight - 10) && black(kWidth / 4 - 3, kHeight / 2));
  EXPECT_FALSE(black(kWidth / 2, kHeight / 2) || black(kWidth / 4 + 3, kHeight / 2));
}

TEST_F(ProgramDisplay, AnOutputThatIsNotThereIsNamedWithItsLine) {
  const std::string walls = folder_.write("two.walls", "wall one  lower-left -2 2 0.5  lower-right 1 2 0.5  "
                                                       "upper-left -2 2 2.5\noutput one monitor nowhere\n");
  const ProgramResult r = runProgram(onDisplay(*display_, {"walls", walls, "--pattern"}));
  EXPECT_EQ(r.status, 2);
  EXPECT_NE(
      r.err.find(
          "two.walls:1:6: error: the output of wall \"one\": there is no monitor \"nowhere\"; there are: "),
      r.err.npos)
      << r.err;
}

TEST(ProgramWalls, ThePatternIsWrittenForBothEyes) {
  const TestFolder folder;
  const ProgramResult r =
      stadionProgram({"walls", "cave4", "--pattern", "--out", folder.path(), "--size", "300x300"});
  EXPECT_EQ(r.status, 0) << r.err;
  const auto left = readPng(folder.path() / "front-left.png"),
             right = readPng(folder.path() / "front-right.png");
  ASSERT_TRUE(left && right);
  EXPECT_EQ(left.value().width, 300u);
  EXPECT_NE(imageHash(left.value()), imageHash(right.value())) << "letters, and a cube that has a place";
}

}  // namespace
}  // namespace stadion
