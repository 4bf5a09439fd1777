/// Simple shapes must not close what a model leaves open.

#include "dynamics/collision/shape_choice.h"
#include "dynamics/collision/shape_distance.h"
#include "tests/dynamics/world/scenes.h"

#include <gtest/gtest.h>

namespace stadion {
namespace {

using namespace scenes;
using Corners = std::vector<Vec3>;
using Faces = std::vector<std::array<std::uint32_t, 3>>;

/// A wall of 2 m by 2 m, 0.4 m thick, with a doorway of 1 m by 1.5 m.
Mesh archMesh() {
  const std::vector<Vec2> outline{{-1, 0},  {-0.5, 0}, {-0.5, 1.5}, {0.5, 1.5},
                                  {0.5, 0}, {1, 0},    {1, 2},      {-1, 2}};
  const auto n = static_cast<std::uint32_t>(outline.size());
  Corners p;
  for (const double y : {-0.2, 0.2})
    for (const Vec2& c : outline) p.push_back({c.x(), y, c.y()});
  Faces f;
  for (const auto& t : Faces{{0, 1, 2}, {0, 2, 7}, {7, 2, 3}, {7, 3, 6}, {3, 4, 5}, {3, 5, 6}}) {
    f.push_back(t);
    f.push_back({t[0] + n, t[2] + n, t[1] + n});
  }
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t j = (i + 1) % n;
    f.push_back({i, i + n, j + n}), f.push_back({i, j + n, j});
  }
  return meshOf(p, f);
}

/// Two cubes with air between them.
Mesh twinMesh() {
  Mesh m = boxMesh({0.25, 0.5, 0.5});
  const Mesh other = m;
  for (auto& p : m.positions) p[0] -= 0.75f;
  for (const std::uint32_t i : other.indices)
    m.indices.push_back(i + static_cast<std::uint32_t>(other.positions.size()));
  for (auto p : other.positions) p[0] += 0.75f, m.positions.push_back(p);
  return m;
}

/// A ring with a rectangle for its cross section.
Mesh ringMesh(double inner, double outer, double half) {
  constexpr std::uint32_t kSectors = 48, kSides = 4;
  const std::array<Vec2, kSides> section{{{outer, -half}, {outer, half}, {inner, half}, {inner, -half}}};
  Corners p;
  Faces f;
  for (const Vec2& c : section)
    for (std::uint32_t j = 0; j < kSectors; ++j) {
      const double a = 2 * M_PI * j / kSectors;
      p.push_back({c.x() * std::cos(a), c.x() * std::sin(a), c.y()});
    }
  const auto at = [&](std::uint32_t i, std::uint32_t j) { return i % kSides * kSectors + j % kSectors; };
  for (std::uint32_t i = 0; i < kSides; ++i)
    for (std::uint32_t j = 0; j < kSectors; ++j) {
      f.push_back({at(i, j), at(i, j + 1), at(i + 1, j)});
      f.push_back({at(i, j + 1), at(i + 1, j + 1), at(i + 1, j)});
    }
  return meshOf(p, f);
}

/// What of a mesh lies between two heights: a band or a shade, without an inside.
Mesh cutMesh(Mesh m, double from, double to) {
  std::vector<std::uint32_t> kept;
  for (std::size_t i = 0; i + 2 < m.indices.size(); i += 3) {
    bool in = true;
    for (std::size_t k = 0; k < 3; ++k) {
      const double z = m.positions[m.indices[i + k]][2];
      in = in && z >= from && z <= to;
    }
    if (in)
      kept.insert(kept.end(), m.indices.begin() + static_cast<std::ptrdiff_t>(i),
                  m.indices.begin() + static_cast<std::ptrdiff_t>(i + 3));
  }
  m.indices = kept;
  return m;
}

Mesh turnedInside(Mesh m) {
  for (std::size_t i = 0; i + 2 < m.indices.size(); i += 3) std::swap(m.indices[i], m.indices[i + 1]);
  return m;
}

TEST(ShapeHoles, WhatHasAHoleOrIsOpenStaysAMesh) {
  const std::pair<const char*, Mesh> models[] = {
      {"doorway", archMesh()},
      {"two cubes", twinMesh()},
      {"quoit", ringMesh(0.5, 1, 0.1)},
      {"washer", ringMesh(0.2, 1, 0.02)},
      {"pipe", ringMesh(0.98, 1, 1)},
      {"band", cutMesh(ballMesh(1, 24, 48), -0.3, 0.3)},
      {"shade", cutMesh(ballMesh(1, 24, 48), -0.2, 0.8)},
      {"ball without its top", cutMesh(ballMesh(1, 24, 48), -1.1, 0.9)},
      {"room seen from within", turnedInside(boxMesh({2, 2, 1}))},
      {"dome seen from within", turnedInside(ballMesh(1, 24, 48))},
  };
  for (const auto& [name, mesh] : models) {
    const auto choice = chooseShape(mesh);
    ASSERT_TRUE(choice) << name;
    EXPECT_EQ(choice.value().kind, ShapeKind::Mesh) << name << " " << choice.value().remark;
  }
}

TEST(ShapeHoles, AFineModelIsLookedAtAsClosely) {
  const Mesh ball = ballMesh(1, 225, 225);
  EXPECT_EQ(chooseShape(ball).value().kind, ShapeKind::Ball);
  EXPECT_EQ(chooseShape(cutMesh(ball, -1.1, 0.95)).value().kind, ShapeKind::Mesh);
  const auto small = chooseShape(cutMesh(ball, -1.1, 0.996));  // an opening of 0.09 m
  EXPECT_EQ(small.value().kind, ShapeKind::Ball) << "within the tolerance, and";
  EXPECT_NEAR(small.value().deviation, 0.09, 0.01) << "told of";
}

TEST(ShapeHoles, AShapeThatIsAskedForSaysHowFarOffItIs) {
  for (const ShapeKind kind : {ShapeKind::Box, ShapeKind::Convex}) {
    EXPECT_GT(chooseShape(archMesh(), kind).value().deviation, 0.1) << nameOf(kind);
    EXPECT_GT(chooseShape(twinMesh(), kind).value().deviation, 0.2) << nameOf(kind);
    EXPECT_LT(chooseShape(boxMesh({1, 2, 3}), kind).value().deviation, 1e-6) << nameOf(kind);
  }
  EXPECT_GT(chooseShape(ringMesh(0.5, 1, 0.1), ShapeKind::Cylinder).value().deviation, 0.1);
  EXPECT_GT(chooseShape(cutMesh(ballMesh(1, 24, 48), -0.3, 0.3), ShapeKind::Ball).value().deviation, 0.4);
}

TEST(ShapeHoles, TheDistanceOfAShapeAndItsOwnMeshIsThatOfTheFacets) {
  const double facet = 1 - std::cos(M_PI / 24) * std::cos(M_PI / 48);
  const double ball = distanceBetween(BallShape{Vec3::Zero(), 1}, TriangleTree(ballMesh(1, 24, 48)));
  EXPECT_GT(ball, 0.3 * facet);
  EXPECT_LT(ball, 1.5 * facet);
  EXPECT_LT(distanceBetween(BoxShape{{}, {1, 2, 3}}, TriangleTree(boxMesh({1, 2, 3}))), 1e-12);
  // A box that is 0.1 m too long at one end.
  EXPECT_NEAR(distanceBetween(BoxShape{{{0.05, 0, 0}, Quat::Identity()}, {1.05, 2, 3}},
                              TriangleTree(boxMesh({1, 2, 3}))),
              0.1, 1e-9);
}

}  // namespace
}  // namespace stadion
