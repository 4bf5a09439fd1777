#include "dynamics/shapes/triangle_tree.h"

#include "tests/dynamics/world/watch.h"

#include <gtest/gtest.h>

namespace stadion {
namespace {

using scenes::Chance;

/// A ball whose corners have been moved in and out: ridges, hollows and acute edges.
std::vector<std::array<Vec3, 3>> crumpledBall(Chance& chance) {
  constexpr int kRings = 7, kAround = 9;
  std::vector<Vec3> p{{0, 0, chance.between(0.3, 1.5)}, {0, 0, -chance.between(0.3, 1.5)}};
  for (int ring = 1; ring < kRings; ++ring)
    for (int i = 0; i < kAround; ++i) {
      const double down = M_PI * ring / kRings, around = 2 * M_PI * i / kAround, r = chance.between(0.2, 1.5);
      p.push_back(r *
                  Vec3(std::sin(down) * std::cos(around), std::sin(down) * std::sin(around), std::cos(down)));
    }
  const auto at = [&](int ring, int i) {
    return p[static_cast<std::size_t>(2 + (ring - 1) * kAround + i % kAround)];
  };
  std::vector<std::array<Vec3, 3>> triangles;
  for (int i = 0; i < kAround; ++i) {
    triangles.push_back({p[0], at(1, i), at(1, i + 1)});
    triangles.push_back({p[1], at(kRings - 1, i + 1), at(kRings - 1, i)});
    for (int ring = 1; ring + 1 < kRings; ++ring) {
      triangles.push_back({at(ring, i), at(ring + 1, i), at(ring + 1, i + 1)});
      triangles.push_back({at(ring, i), at(ring + 1, i + 1), at(ring, i + 1)});
    }
  }
  return triangles;
}

/// How often the surface winds around x: the solid angles of the triangles (van Oosterom and Strackee, 1983).
double windingAround(const Vec3& x, const std::vector<std::array<Vec3, 3>>& triangles) {
  double sum = 0;
  for (const auto& t : triangles) {
    const Vec3 a = t[0] - x, b = t[1] - x, c = t[2] - x;
    const double la = a.norm(), lb = b.norm(), lc = c.norm();
    sum += 2 * std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
  }
  return sum / (4 * M_PI);
}

TEST(TriangleTree, KnowsInsideFromOutsideAlsoAtAcuteEdges) {
  Chance chance(5);
  int inside = 0;
  for (int shape = 0; shape < 40; ++shape) {
    const auto triangles = crumpledBall(chance);
    const TriangleTree tree(triangles);
    ASSERT_TRUE(tree.closed());
    for (int i = 0; i < 500; ++i) {
      Vec3 x = 1.6 * chance.vector();
      if (i % 2) {  // near the edges
        const auto& t =
            triangles[static_cast<std::size_t>(chance.between(0, 1) * double(triangles.size() - 1))];
        const double share = chance.between(0, 1);
        x = t[0] + share * (t[1] - t[0]) + 0.02 * chance.vector();
      }
      const double winding = windingAround(x, triangles);
      ASSERT_EQ(tree.encloses(x), winding > 0.5)
          << "shape " << shape << " point " << i << " winds " << winding;
      inside += winding > 0.5;
    }
  }
  EXPECT_GT(inside, 2000);
}

}  // namespace
}  // namespace stadion
