#include "engine/display/unfolding.h"

#include <gtest/gtest.h>

namespace stadion {
namespace {

std::vector<WallEntry> wallsOf(const std::string& name) {
  Diagnostics out;
  const auto walls = loadWalls(name, std::string(STADION_SOURCE_DIR) + "/walls", out);
  return walls ? walls->walls : std::vector<WallEntry>{};
}

bool apart(const SheetPlace& a, const SheetPlace& b) {
  const auto right = [](const SheetPlace& p) { return p.x + static_cast<std::int32_t>(p.width); };
  const auto low = [](const SheetPlace& p) { return p.y + static_cast<std::int32_t>(p.height); };
  return right(a) <= b.x || right(b) <= a.x || low(a) <= b.y || low(b) <= a.y;
}

TEST(Unfolding, PutsLeftFrontAndRightBesideEachOtherAndTheFloorBelow) {
  const std::vector<SheetPlace> p = unfold(wallsOf("cave4"), 1200, 800);
  ASSERT_EQ(p.size(), 4u);  // front, left, right, floor
  EXPECT_LT(p[1].x, p[0].x);
  EXPECT_LT(p[0].x, p[2].x);
  EXPECT_EQ(p[1].y, p[0].y);
  EXPECT_GT(p[3].y, p[0].y);
  EXPECT_EQ(p[3].x, p[0].x);
  EXPECT_EQ(p[0].width, p[0].height) << "square walls are square";
}

TEST(Unfolding, KeepsWallsApartAndInsideTheSheet) {
  for (const char* name : {"cave4", "cave6", "powerwall", "desktop"})
    for (const auto& [width, height] : {std::pair(1200u, 800u), std::pair(300u, 900u)}) {
      const std::vector<SheetPlace> p = unfold(wallsOf(name), width, height);
      for (std::size_t i = 0; i < p.size(); ++i) {
        EXPECT_GE(p[i].x, 0);
        EXPECT_GE(p[i].y, 0);
        EXPECT_LE(p[i].x + p[i].width, width);
        EXPECT_LE(p[i].y + p[i].height, height);
        for (std::size_t j = i + 1; j < p.size(); ++j) EXPECT_TRUE(apart(p[i], p[j])) << name << i << j;
      }
    }
}

TEST(Unfolding, StandsTwoScreensInACornerInARow) {
  Diagnostics out;
  const auto walls =
      parseWalls("unit cm\n"
                 "wall right  lower-left 0 200 40   lower-right 170 30 40   upper-left 0 200 240\n"
                 "wall left   lower-left -170 30 40   lower-right 0 200 40   upper-left -170 30 240\n",
                 "t.walls", out);
  ASSERT_TRUE(walls);
  const std::vector<SheetPlace> p = unfold(walls->walls, 1000, 500);
  EXPECT_LT(p[1].x, p[0].x) << "left is to the left, whatever comes first in the file";
  EXPECT_TRUE(apart(p[0], p[1]));
}

}  // namespace
}  // namespace stadion
