/// Where walls come out, as their file says, and what is done to the pictures on the way.

#include "engine/display/output_reader.h"
#include "engine/display/wall_file.h"

#include <gtest/gtest.h>

namespace stadion {
namespace {

const std::string kWall = "wall front  lower-left -1.5 1.5 0  lower-right 1.5 1.5 0  upper-left -1.5 1.5 3\n";

std::optional<WallFile> parsed(const std::string& output, std::string* said = nullptr) {
  Diagnostics out;
  auto walls = parseWalls(kWall + output + "\n", "t.walls", out);
  if (said)
    for (const Diagnostic& d : out.all())
      *said += std::to_string(d.where.line) + ":" + std::to_string(d.where.column) + ": " + d.message + "\n";
  return walls;
}

TEST(Output, IsReadWithAllItsFields) {
  const auto walls =
      parsed("output front  screen :0.1  monitor HDMI-1  rectangle -10 20 1920 1200  flip-h  flip-v  "
             "rotate 270  swap-eyes  gamma 1.1  brightness 0.9 1 0.95  "
             "warp 0 0.01  1 0  0.98 1  0.02 0.97");
  ASSERT_TRUE(walls && walls->walls[0].output);
  const WallOutput& o = *walls->walls[0].output;
  EXPECT_EQ(o.place.screen, ":0.1");
  EXPECT_EQ(o.place.monitor, "HDMI-1");
  EXPECT_EQ(*o.place.rectangle, (OutputPlace::Rectangle{-10, 20, 1920, 1200}));
  EXPECT_TRUE(o.shape.flipH && o.shape.flipV && o.shape.swapEyes);
  EXPECT_EQ(o.shape.rotate, 270u);
  EXPECT_EQ(o.shape.gamma, (std::array<double, 3>{1.1, 1.1, 1.1}));
  EXPECT_EQ(o.shape.brightness, (std::array<double, 3>{0.9, 1, 0.95}));
  EXPECT_EQ((*o.shape.warp)[2], Vec2(0.98, 1));

  Diagnostics none;
  const auto again = parseWalls(formatWalls(*walls), "t.walls", none);
  ASSERT_TRUE(again) << formatWalls(*walls);
  EXPECT_EQ(*again->walls[0].output, o);
}

TEST(Output, MayStandAboveItsWallAndMayChooseItsRefreshRate) {
  Diagnostics out;
  const auto walls = parseWalls("output front fullscreen refresh 120\n" + kWall, "t.walls", out);
  ASSERT_TRUE(walls && walls->walls[0].output);
  EXPECT_TRUE(walls->walls[0].output->place.fullscreen);
  EXPECT_EQ(walls->walls[0].output->place.refresh, 120u);
}

TEST(Output, ThatIsWrongIsToldWithItsPlaceAndTheWayToMendIt) {
  const std::pair<const char*, const char*> kWrong[] = {
      {"output", "2:7: the name of the output's wall is missing"},
      {"output frnt", "2:8: there is no wall \"frnt\"; did you mean \"front\"?"},
      {"output front flip", "2:14: \"flip\" is not a field of an output"},
      {"output front fliph", "2:14: \"fliph\" is not a field of an output; did you mean \"flip-h\"?"},
      {"output front flip-h flip-h", "2:21: \"flip-h\" is given twice for this output; keep one of them"},
      {"output front rotate 45",
       "2:21: \"45\" is not a turn that a picture can make; write 90, 180 or 270 (clockwise)"},
      {"output front screen 0.1", "2:21: \"0.1\" is not an X screen; write :DISPLAY.SCREEN, such as :0.1"},
      {"output front rectangle 0 0 800", "2:31: the height of the rectangle [pixels] is missing"},
      {"output front rectangle 0 0 800 0",
       "2:32: the height of the rectangle [pixels] must be from 1 to 16384, not 0"},
      {"output front rectangle 0 0.5 800 1",
       "2:26: y of the rectangle [pixels] must be a whole number, not 0.5"},
      {"output front rectangle 0 0 8 6 fullscreen",
       "2:1: an output has a rectangle or is fullscreen, not both; leave one of them out"},
      {"output front refresh 60",
       "2:1: only a fullscreen output can choose its refresh rate; add fullscreen, or leave refresh out"},
      {"output front gamma 0", "2:20: gamma must be from 0.1 to 10, not 0"},
      {"output front brightness 1 2 1", "2:27: brightness of green must be from 0 to 1, not 2"},
      {"output front warp 0 0 1 0 0 1 1 1",
       "2:14: the corners of warp make no picture; give upper left, upper right, "
       "lower right, lower left, as shares of the output from its upper left "
       "corner (0 0  1 0  1 1  0 1 changes nothing)"},
      {"output front flip-h\noutput front flip-v",
       "3:8: wall \"front\" has an output already, on line 2; keep one of them"}};
  for (const auto& [line, expected] : kWrong) {
    std::string said;
    EXPECT_FALSE(parsed(line, &said)) << line;
    EXPECT_TRUE(said.starts_with(expected)) << line << "\n" << said;
  }
}

/// Where the picture's point is taken from for a point of the output.
Vec2 shownAt(const OutputShape& shape, double s, double t) {
  const Vec3 at = pictureFromOutput(shape) * Vec3(s, t, 1);
  return at.head<2>() / at.z();
}

TEST(Output, MirrorsThenTurnsThePicture) {
  const Vec2 upperLeft(0, 0), upperRight(1, 0), lowerRight(1, 1), lowerLeft(0, 1);
  OutputShape shape;
  EXPECT_EQ(shownAt(shape, 0, 0), upperLeft);
  shape.flipH = true;
  EXPECT_EQ(shownAt(shape, 0, 0), upperRight);
  shape.flipV = true;
  EXPECT_EQ(shownAt(shape, 0, 0), lowerRight);
  shape = {};
  shape.rotate = 90;  // what was at the upper left is at the upper right
  EXPECT_EQ(shownAt(shape, 1, 0), upperLeft);
  EXPECT_EQ(shownAt(shape, 0, 0), lowerLeft);
  shape.rotate = 180;
  EXPECT_EQ(shownAt(shape, 0, 0), lowerRight);
  shape.rotate = 270;
  EXPECT_EQ(shownAt(shape, 0, 1), upperLeft);
  shape.rotate = 90, shape.flipH = true;  // mirrored, the upper right is at the left; turned, it is up
  EXPECT_EQ(shownAt(shape, 1, 0), upperRight);
}

TEST(Output, WarpPutsTheCornersWhereTheyAreSaidToBe) {
  OutputShape shape;
  shape.warp = {{Vec2(0.1, 0.05), Vec2(0.9, 0.1), Vec2(1, 0.95), Vec2(0.02, 0.8)}};
  const Vec2 corners[] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  for (std::size_t i = 0; i < 4; ++i)
    EXPECT_LT((shownAt(shape, (*shape.warp)[i].x(), (*shape.warp)[i].y()) - corners[i]).norm(), 1e-9) << i;
  EXPECT_LT(shownAt(shape, 0, 0).minCoeff(), 0) << "outside is outside";
}

}  // namespace
}  // namespace stadion
