/// Windows with and without OpenGL on a display in memory: photographed, and compared pixel by pixel.

#include "show/display/show_windows.h"

#include "tests/programs/desk.h"

#include <algorithm>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <random>
#include <thread>

namespace stadion {
namespace {

constexpr std::uint32_t kWide = 160, kHigh = 121;

/// Noise over a slope: nothing is worse for a filter.
Picture noise(std::uint32_t seed, std::uint32_t width, std::uint32_t height) {
  std::mt19937 random(seed);
  Picture picture(width, height);
  for (std::uint32_t y = 0; y < height; ++y)
    for (std::uint32_t x = 0; x < width; ++x)
      for (std::uint32_t c = 0; c < 3; ++c)
        picture.at(x, y)[c] = static_cast<std::uint8_t>(
            (x / 16 + y / 16) % 2 == 0 ? random() % 256 : (x * (c + 1) + y * (3 - c)) % 256);
  return picture;
}

/// A text panel's look: some of it hides what is below, some does not.
Picture panel(std::uint32_t seed, std::uint32_t width, std::uint32_t height) {
  Picture picture = noise(seed, width, height);
  for (std::size_t i = 3, n = 0; i < picture.rgba.size(); i += 4, ++n)
    picture.rgba[i] = static_cast<std::uint8_t>(n * 7);
  return picture;
}

/// What a window shall show.
struct Scenery {
  WindowStereo stereo = WindowStereo::Mono;
  std::vector<WindowPane> panes{{0, {0, 0, kWide, kHigh}, {}}};
  std::uint32_t pictureWidth = kWide, pictureHeight = kHigh;
  bool panels = false;
  int top = 20;  ///< of the window on the screen
};

struct Difference {
  int most = 0;
  double share = 0;  ///< of the channels that differ
};

Difference difference(const Picture& a, const Picture& b) {
  Difference d;
  EXPECT_TRUE(a.sameSize(b));
  if (!a.sameSize(b)) return {255, 1};
  std::size_t count = 0;
  for (std::size_t i = 0; i < a.rgba.size(); ++i) {
    const int apart = std::abs(a.rgba[i] - b.rgba[i]);
    d.most = std::max(d.most, apart), count += apart > 0;
  }
  d.share = static_cast<double>(count) / static_cast<double>(a.rgba.size());
  return d;
}

class ProgramShowWindows : public testing::Test {
protected:
  void SetUp() override { connect({"400x300x24"}); }

  void connect(std::vector<std::string> screens, std::vector<std::string> more = {}) {
    system_.reset();
    display_ = Display::open(std::move(screens), std::move(more));
    if (!display_) GTEST_SKIP() << "needs Xvfb, xdotool and import: apt-get install xvfb xdotool imagemagick";
    auto system = WindowSystem::open(display_->name());
    ASSERT_TRUE(system) << system.error().message;
    system_ = std::move(system.value());
  }
  void TearDown() override { system_.reset(); }

  std::unique_ptr<ShowWindow> open(const Scenery& s, WindowSurface surface) {
    WindowPlan plan;
    plan.title = "Stadion: windows";
    plan.surface = surface;
    plan.width = kWide, plan.height = kHigh;
    plan.frame = false, plan.placed = true, plan.x = 30, plan.y = s.top;
    auto window = ShowWindow::open(*system_, plan, s.stereo, 2);
    EXPECT_TRUE(window) << window.error().message;
    if (!window) return nullptr;
    EXPECT_EQ(window.value()->window().pixels() != nullptr, surface == WindowSurface::Pixels);
    return std::move(window.value());
  }

  void give(const Scenery& s, ShowWindow& window) {
    const std::uint32_t w = s.pictureWidth, h = s.pictureHeight;
    pictures_.resize(2);
    for (std::uint32_t wall = 0; wall < 2; ++wall)
      pictures_[wall].eyes = {noise(10 + wall, w, h), noise(20 + wall, w, h)};
    window.take(pictures_, {0, 1});
    if (!s.panels) return;
    window.setOverlay(0, panel(1, 40, 20));
    window.setOverlay(1, panel(2, 300, 15), true);
  }

  Picture photo(int top) {
    const std::string file = folder_.path() / "screen.png";
    EXPECT_TRUE(display_->photograph(file));
    const auto all = readPng(file);
    if (!all) return {};
    Picture part(kWide, kHigh);
    for (std::uint32_t v = 0; v < kHigh; ++v)
      std::copy_n(all.value().at(30, static_cast<std::uint32_t>(top) + v), std::size_t{kWide} * 4,
                  part.at(0, v));
    return part;
  }

  /// Waits until the screen shows that within `most` of each value.
  bool seen(const Picture& wanted, int top, int most = 0) {
    for (int tries = 0; tries < 100; ++tries) {
      system_->poll();
      if (difference(photo(top), wanted).most <= most) return true;
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    return false;
  }

  /// What stands on the screen, which is what the window says that it drew.
  Picture shown(const Scenery& s, WindowSurface surface) {
    const auto window = open(s, surface);
    if (!window) return {};
    give(s, *window);
    const Picture drawn = *window->draw(s.panes, true);
    window->show();
    EXPECT_TRUE(seen(drawn, s.top)) << "the screen shows something else";
    return drawn;
  }

  /// Both ways show the same within `most` of 255.
  Difference expectSame(const std::string& what, const Scenery& s, int most) {
    SCOPED_TRACE(what);
    const Picture gl = shown(s, WindowSurface::OpenGl), pixels = shown(s, WindowSurface::Pixels);
    const Difference d = difference(gl, pixels);
    EXPECT_LE(d.most, most) << 100 * d.share << " % of the values differ";
    fmt::print("{:<28} most {} of 255, {:.3f} % differ\n", what, d.most, 100 * d.share);
    return d;
  }

  TestFolder folder_;
  std::unique_ptr<Display> display_;
  std::unique_ptr<WindowSystem> system_;
  std::vector<EyePictures> pictures_;
};

Scenery shaped(const OutputShape& shape, WindowStereo stereo = WindowStereo::Mono) {
  Scenery s;
  s.stereo = stereo;
  s.panes[0].shape = shape;
  return s;
}

TEST_F(ProgramShowWindows, PicturesThatFillTheirPlaceAreTheSameWithAndWithoutOpenGl) {
  expectSame("mono", {}, 0);
  OutputShape turned;
  turned.flipH = true;
  expectSame("mirrored", shaped(turned), 0);
  turned.rotate = 180, turned.swapEyes = true;
  expectSame("mirrored and turned", shaped(turned), 0);
  for (const std::uint32_t rotate : {90u, 270u}) {
    OutputShape quarter;
    quarter.rotate = rotate, quarter.flipV = rotate == 270;
    Scenery s = shaped(quarter);
    s.pictureWidth = kHigh, s.pictureHeight = kWide;
    expectSame(fmt::format("turned by {}", rotate), s, 0);
  }
  Scenery two;
  two.pictureWidth = 70, two.pictureHeight = 50;
  two.panes = {{0, {3, 5, 70, 50}, {}}, {1, {80, 60, 70, 50}, {}}};
  expectSame("two walls and black between", two, 0);
}

TEST_F(ProgramShowWindows, EachLayoutOfTheEyesIsTheSameWithAndWithoutOpenGl) {
  for (const int top : {20, 21}) {
    Scenery s;
    s.stereo = WindowStereo::Interlaced, s.top = top;
    expectSame(fmt::format("interlaced at row {}", top), s, 0);
  }
  Scenery small;
  small.stereo = WindowStereo::Interlaced;
  small.pictureWidth = 97, small.pictureHeight = 200;
  expectSame("interlaced, stretched", small, 1);
  Scenery halves;
  halves.stereo = WindowStereo::SideBySide;
  expectSame("side by side", halves, 1);
  halves.stereo = WindowStereo::TopBottom;
  expectSame("top and bottom", halves, 1);
  Scenery glasses;
  glasses.stereo = WindowStereo::Anaglyph;
  const Difference exact = expectSame("anaglyph", glasses, 1);
  EXPECT_LT(exact.share, 0.001) << "a rounding here and there";
  glasses.pictureWidth = 100, glasses.pictureHeight = 75;
  expectSame("anaglyph, stretched", glasses, 1);
}

TEST_F(ProgramShowWindows, StretchedAndWarpedPicturesAndColoursAreTheSameWithAndWithoutOpenGl) {
  for (const std::array<std::uint32_t, 2> size : {std::array{63u, 40u}, {231u, 170u}, {kWide, 50u}}) {
    Scenery s;
    s.pictureWidth = size[0], s.pictureHeight = size[1];
    expectSame(fmt::format("from {} x {}", size[0], size[1]), s, 1);
  }
  OutputShape quarter;
  quarter.rotate = 90;
  expectSame("turned by 90 and stretched", shaped(quarter), 1);
  OutputShape warped;
  warped.warp = {Vec2(0.02, 0.13), Vec2(0.97, 0.03), Vec2(0.91, 0.98), Vec2(0.11, 0.87)};
  expectSame("warped", shaped(warped), 1);
  warped.flipH = true, warped.gamma = {1.3, 0.8, 1}, warped.brightness = {0.9, 1, 0.5};
  expectSame("warped with colours", shaped(warped), 1);
  warped.warp.reset();
  expectSame("colours", shaped(warped), 1);
  expectSame("anaglyph with colours", shaped(warped, WindowStereo::Anaglyph), 1);
  Scenery panels;
  panels.panels = true;
  expectSame("panels", panels, 1);
  panels.stereo = WindowStereo::SideBySide;
  expectSame("panels in both halves", panels, 1);
}

TEST_F(ProgramShowWindows, AServerWithoutSharedMemoryShowsTheSame) {
  const auto shared = system_->pixelsWay();
  ASSERT_TRUE(shared) << shared.error().message;
  EXPECT_EQ(shared.value(), "shared memory");
  const Picture wanted = shown({}, WindowSurface::Pixels);
  connect({"400x300x24"}, {"-extension", "MIT-SHM"});
  const auto sent = system_->pixelsWay();
  ASSERT_TRUE(sent) << sent.error().message;
  EXPECT_EQ(sent.value(), "pictures through the connection");
  EXPECT_EQ(shown({}, WindowSurface::Pixels).rgba, wanted.rgba);
}

TEST_F(ProgramShowWindows, OtherPixelsAreConvertedOrRefused) {
  connect({"400x300x16"});
  EXPECT_EQ(system_->pixelsWay().value(), "shared memory, converted to 16 bits a pixel");
  const Scenery s;
  const auto window = open(s, WindowSurface::Pixels);
  ASSERT_TRUE(window);
  give(s, *window);
  const Picture drawn = *window->draw(s.panes, true);
  window->show();
  EXPECT_TRUE(seen(drawn, s.top, 5)) << "5 bits have steps of 8.2";
}

TEST_F(ProgramShowWindows, ATableOfColoursIsRefusedWithTheMend) {
  connect({"400x300x8"});
  const auto way = system_->pixelsWay();
  ASSERT_FALSE(way);
  EXPECT_NE(way.error().message.find("--renderer gl"), std::string::npos) << way.error().message;
  WindowPlan plan;
  plan.surface = WindowSurface::Pixels;
  EXPECT_FALSE(ShowWindow::open(*system_, plan, WindowStereo::Mono, 1));
}

TEST_F(ProgramShowWindows, AWindowOfAnotherSizeIsFilledAndAnUncoveredOneIsShownAgain) {
  const Scenery s;
  const auto window = open(s, WindowSurface::Pixels);
  ASSERT_TRUE(window);
  give(s, *window);
  window->draw(s.panes);
  window->show();
  display_->hands({"search", "--sync", "--name", "Stadion: windows", "windowsize", "100", "90"});
  for (int tries = 0; tries < 100 && window->window().size() != std::array{100u, 90u}; ++tries)
    system_->poll(), std::this_thread::sleep_for(std::chrono::milliseconds(10));
  ASSERT_EQ(window->window().size(), (std::array{100u, 90u}));
  const std::vector<WindowPane> panes{{0, {0, 0, 100, 90}, {}}};
  const Picture small = *window->draw(panes, true);
  EXPECT_EQ(small.width, 100u);
  window->show();
  const auto corner = [&](const Picture& p) {
    return p.empty() ? std::vector<std::uint8_t>{} : std::vector<std::uint8_t>(p.at(40, 30), p.at(90, 30));
  };
  const auto cornerSeen = [&](const std::vector<std::uint8_t>& wanted) {
    for (int tries = 0; tries < 100; ++tries) {
      system_->poll();
      if (corner(photo(s.top)) == wanted) return true;
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    return false;
  };
  EXPECT_TRUE(cornerSeen(corner(small)));
  const Scenery other;
  auto above = open(other, WindowSurface::Pixels);
  ASSERT_TRUE(above);
  std::vector<EyePictures> others(2);
  others[0].eyes = {noise(99, kWide, kHigh)};
  above->take(others, {0});
  const Picture over = *above->draw(other.panes, true);
  above->show();
  EXPECT_TRUE(cornerSeen(corner(over)));
  above.reset();
  EXPECT_TRUE(cornerSeen(corner(small))) << "no new picture was drawn";
}

TEST(WindowSurfaces, WindowsHaveOpenGlWhereItDrawsOrALayoutNeedsIt) {
  EXPECT_EQ(windowSurface(true, WindowStereo::Mono), WindowSurface::OpenGl);
  EXPECT_EQ(windowSurface(false, WindowStereo::Quad), WindowSurface::OpenGl);
  for (const WindowStereo stereo : {WindowStereo::Mono, WindowStereo::SideBySide, WindowStereo::TopBottom,
                                    WindowStereo::Anaglyph, WindowStereo::Interlaced})
    EXPECT_EQ(windowSurface(false, stereo), WindowSurface::Pixels);
}

}  // namespace
}  // namespace stadion
