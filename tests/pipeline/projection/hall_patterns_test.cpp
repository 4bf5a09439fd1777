/// Patterns for setting up walls and projectors.

#include "engine/maths/angles.h"
#include "engine/maths/srgb.h"
#include "pipeline/projection/hall_patterns.h"
#include "tests/pipeline/projection/round_hall.h"

#include <gtest/gtest.h>
#include <set>

namespace stadion {
namespace {

WallFile mixedHall() {
  WallFile hall = test::roundHall(2, 60 * kDegree, 0.2);
  hall.walls[1].projector->eye = Eye::Right;
  WallEntry flat;
  flat.wall = {"flat", {-1, 2, 0}, {1, 2, 0}, {-1, 2, 2}};
  hall.walls.push_back(flat);
  return hall;
}

TEST(HallPatterns, EachOutputGetsPicturesOfItsSizeForItsEyes) {
  for (const bool stereo : {false, true}) {
    auto patterns = HallPatterns::create(mixedHall(), stereo);
    ASSERT_TRUE(patterns) << patterns.error().message;
    for (const HallPattern kind : {HallPattern::Room, HallPattern::Pixels, HallPattern::Blend,
                                   HallPattern::Gamma, HallPattern::Bars}) {
      const auto both = patterns.value()->pictures(0, kind, 99, 99),
                 right = patterns.value()->pictures(1, kind, 99, 99),
                 flat = patterns.value()->pictures(2, kind, 200, 100);
      EXPECT_EQ(both.size(), stereo ? 2U : 1U);
      EXPECT_EQ(right.size(), 1U);
      EXPECT_EQ(flat.size(), stereo ? 2U : 1U);
      EXPECT_EQ(both[0].width, 640U);
      EXPECT_EQ(flat[0].height, 100U);
    }
  }
}

TEST(HallPatterns, KindsDiffer) {
  auto patterns = HallPatterns::create(mixedHall(), true);
  ASSERT_TRUE(patterns);
  std::set<std::uint64_t> hashes;
  for (const HallPattern kind :
       {HallPattern::Room, HallPattern::Pixels, HallPattern::Blend, HallPattern::Gamma, HallPattern::Bars})
    hashes.insert(imageHash(patterns.value()->pictures(0, kind, 0, 0)[0]));
  EXPECT_EQ(hashes.size(), 5U);
}

double greenAt(const Picture& picture, const Vec2& share) {
  const auto x = std::min(picture.width - 1, static_cast<std::uint32_t>(share.x() * picture.width));
  const auto y = std::min(picture.height - 1, static_cast<std::uint32_t>(share.y() * picture.height));
  return linearFromSrgb(picture.at(x, y)[1] / 255.0);
}

TEST(HallPatterns, RoomLinesOfNeighboursLieOnEachOther) {
  const WallFile hall = test::roundHall(2, 60 * kDegree, 0.3);
  auto patterns = HallPatterns::create(hall, false);
  ASSERT_TRUE(patterns);
  std::vector<Picture> room, white;
  for (const std::size_t i : {0U, 1U}) {
    room.push_back(patterns.value()->pictures(i, HallPattern::Room, 0, 0)[0]);
    white.push_back(patterns.value()->pictures(i, HallPattern::Blend, 0, 0)[0]);
  }
  const ScreenSurface surface(hall.screens[0]);
  const ThrownImage a(*hall.walls[0].projector, surface), b(*hall.walls[1].projector, surface);
  std::size_t compared = 0, alike = 0;
  for (std::uint32_t y = 110; y < 290; ++y)
    for (std::uint32_t x = 520; x < 640; ++x) {
      const Vec2 here((x + 0.5) / 640, (y + 0.5) / 400);
      const auto point = a.pointAt(here);
      const auto there = point ? b.shareOf(*point) : std::nullopt;
      if (!there) continue;
      const double shareA = greenAt(white[0], here), shareB = greenAt(white[1], *there);
      if (std::min(shareA, shareB) < 0.2) continue;  // steps of 8 bits
      alike += std::abs(greenAt(room[0], here) / shareA - greenAt(room[1], *there) / shareB) < 0.15;
      ++compared;
    }
  EXPECT_GT(compared, 3000U);
  EXPECT_GT(alike, compared * 95 / 100);
}

}  // namespace
}  // namespace stadion
