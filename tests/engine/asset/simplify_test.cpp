/// Simplified levels have fewer and fewer triangles, and no point of them is farther from the full surface
/// than they say.

#include "engine/asset/simplify.h"
#include "engine/maths/angles.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <random>

namespace stadion {
namespace {

/// A ball of radius 1, or, squashed, anything like it.
Mesh ball(int rings, double height = 1) {
  Mesh m;
  m.materials.emplace_back();
  const int sectors = 2 * rings;
  for (int r = 0; r <= rings; ++r)
    for (int s = 0; s < sectors; ++s) {
      const double a = kPi * r / rings, b = 2 * kPi * s / sectors;
      m.positions.push_back({static_cast<float>(std::sin(a) * std::cos(b)),
                             static_cast<float>(std::sin(a) * std::sin(b)),
                             static_cast<float>(height * std::cos(a))});
      m.normals.push_back(m.positions.back());
    }
  const auto at = [&](int r, int s) { return static_cast<std::uint32_t>(r * sectors + s % sectors); };
  for (int r = 0; r < rings; ++r)
    for (int s = 0; s < sectors; ++s)
      for (const std::uint32_t i :
           {at(r, s), at(r + 1, s), at(r + 1, s + 1), at(r, s), at(r + 1, s + 1), at(r, s + 1)})
        m.indices.push_back(i);
  m.submeshes.push_back({0, static_cast<std::uint32_t>(m.indices.size()), 0});
  m.bounds = {Vec3(-1, -1, -height), Vec3(1, 1, height)};
  m.sphere = {Vec3::Zero(), 1};
  m.hash = 1;
  return m;
}

Vec3 cornerOf(const Mesh& m, const std::vector<std::uint32_t>& indices, std::size_t i) {
  const auto& p = m.positions[indices[i]];
  return {double{p[0]}, double{p[1]}, double{p[2]}};
}

TEST(Simplify, EachLevelHasFewerTrianglesAndAGreaterErrorThanTheOneBefore) {
  Mesh m = ball(48);
  const std::vector<std::uint32_t> full = m.indices;
  addLevels(m, 4);
  ASSERT_GE(m.levels.size(), 3U);
  EXPECT_EQ(m.indices, full);
  std::size_t before = full.size();
  double error = 0;
  for (const MeshLevel& level : m.levels) {
    EXPECT_LE(level.indices.size(), before * 3 / 4);
    EXPECT_GT(level.indices.size(), 0U);
    EXPECT_GE(level.error, error);
    ASSERT_EQ(level.submeshes.size(), 1U);
    EXPECT_EQ(level.submeshes[0].indexCount, level.indices.size());
    before = level.indices.size(), error = level.error;
  }
  EXPECT_GT(error, 0);
}

TEST(Simplify, NoPointOfALevelIsFartherFromTheSurfaceThanItsError) {
  Mesh m = ball(48);
  addLevels(m, 4);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> part(0, 1);
  const double faceted = 1 - std::cos(3.1416 / 48);  // the full mesh itself is inside the ball by that
  for (const MeshLevel& level : m.levels)
    for (std::size_t i = 0; i + 2 < level.indices.size(); i += 3)
      for (int k = 0; k < 20; ++k) {
        double u = part(random), v = part(random);
        if (u + v > 1) u = 1 - u, v = 1 - v;
        const Vec3 a = cornerOf(m, level.indices, i), b = cornerOf(m, level.indices, i + 1),
                   c = cornerOf(m, level.indices, i + 2);
        const Vec3 p = a + u * (b - a) + v * (c - a);
        EXPECT_LE(1 - p.norm(), level.error + faceted + 1e-9);
      }
}

TEST(Simplify, WhatIsFlatLosesItsTrianglesForNothing) {
  Mesh m;
  m.materials.emplace_back();
  constexpr std::uint32_t kSide = 40;
  for (std::uint32_t y = 0; y <= kSide; ++y)
    for (std::uint32_t x = 0; x <= kSide; ++x)
      m.positions.push_back({static_cast<float>(x), static_cast<float>(y), 0});
  m.normals.assign(m.positions.size(), {0, 0, 1});
  const auto at = [](std::uint32_t x, std::uint32_t y) { return y * (kSide + 1) + x; };
  for (std::uint32_t y = 0; y < kSide; ++y)
    for (std::uint32_t x = 0; x < kSide; ++x)
      for (const std::uint32_t i :
           {at(x, y), at(x + 1, y), at(x + 1, y + 1), at(x, y), at(x + 1, y + 1), at(x, y + 1)})
        m.indices.push_back(i);
  m.submeshes.push_back({0, static_cast<std::uint32_t>(m.indices.size()), 0});
  m.sphere = {Vec3(20, 20, 0), 28.3};
  addLevels(m, 3);
  ASSERT_GE(m.levels.size(), 1U);
  EXPECT_LT(m.levels[0].error, 1e-4);
  EXPECT_LT(m.levels[0].indices.size(), m.indices.size() / 10);
}

TEST(Simplify, ItIsAnotherMeshThanWithoutLevels) {
  Mesh plain = ball(24), levelled = ball(24), finer = ball(24);
  addLevels(levelled, 1), addLevels(finer, 3);
  EXPECT_NE(levelled.hash, plain.hash);
  EXPECT_NE(levelled.hash, finer.hash);
  Mesh again = ball(24);
  addLevels(again, 1);
  EXPECT_EQ(again.hash, levelled.hash);
  EXPECT_EQ(again.levels[0].indices, levelled.levels[0].indices);
}

TEST(Simplify, WhatCannotBeSimplifiedWithinTheErrorStaysAsItIs) {
  // Beside the ball a cube of twelve triangles that hangs together: without a corner it would be far off.
  Mesh m = ball(48);
  const auto first = static_cast<std::uint32_t>(m.positions.size());
  for (std::uint32_t corner = 0; corner < 8; ++corner) {
    m.positions.push_back({3 + float(corner & 1), float(corner >> 1 & 1), float(corner >> 2)});
    m.normals.push_back({0, 0, 1});
  }
  const std::uint32_t quads[6][4] = {{0, 1, 3, 2}, {4, 6, 7, 5}, {0, 4, 5, 1},
                                     {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 5, 7, 3}};
  for (const auto& q : quads)
    for (const std::uint32_t i : {q[0], q[1], q[2], q[0], q[2], q[3]}) m.indices.push_back(first + i);
  m.submeshes[0].indexCount = static_cast<std::uint32_t>(m.indices.size());
  addLevels(m, 2);
  ASSERT_FALSE(m.levels.empty());
  for (const MeshLevel& level : m.levels)
    EXPECT_EQ(std::ranges::count_if(level.indices, [&](std::uint32_t v) { return v >= first; }), 36);
}

TEST(Simplify, WhatIsPaintedOnASurfaceStaysThere) {
  Mesh plain = ball(48), speckled = ball(48);
  for (std::size_t v = 0; v < speckled.positions.size(); ++v) {
    plain.colours.push_back({90, 90, 90, 255});
    speckled.colours.push_back({static_cast<std::uint8_t>(v % 2 == 0 ? 255 : 90), 90, 90, 255});
  }
  addLevels(plain, 4), addLevels(speckled, 4);
  EXPECT_GE(plain.levels.size(), 3U);
  EXPECT_TRUE(speckled.levels.empty());
}

TEST(Simplify, WhatHasFewTrianglesStaysAsItIs) {
  Mesh m = ball(2);
  addLevels(m, 4);
  EXPECT_TRUE(m.levels.empty());
}

}  // namespace
}  // namespace stadion
