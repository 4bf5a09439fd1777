/// Meshes that no modeller should save, as what bodies fall on and as bodies.

#include "dynamics/collision/shape_choice.h"
#include "tests/dynamics/world/watch.h"

#include <gtest/gtest.h>

namespace stadion {
namespace {

using namespace scenes;

/// The same mesh with all that can be wrong with triangles among the good ones.
Mesh spoilt(Mesh m, unsigned seed) {
  Chance chance(seed);
  const auto good = m.indices;
  const auto corners = static_cast<std::uint32_t>(m.positions.size());
  const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    m.indices.insert(m.indices.end(), {a, b, c});
  };
  for (std::size_t i = 0; i + 2 < good.size(); i += 3) {
    const std::uint32_t a = good[i], b = good[i + 1], c = good[i + 2];
    switch (static_cast<int>(chance.between(0, 8))) {
    case 0: add(a, a, b); break;                // no area
    case 1: add(a, b, c); break;                // twice
    case 2: add(b, c, a); break;                // twice, turned
    case 3: add(a, b, corners + 99999); break;  // a corner that does not exist
    case 4: {                                   // a needle along an edge
      auto p = m.positions[a], q = m.positions[b];
      for (std::size_t k = 0; k < 3; ++k) p[k] += 1e-7f * (q[k] - p[k]);
      m.positions.push_back(p);
      add(a, b, static_cast<std::uint32_t>(m.positions.size() - 1));
      break;
    }
    case 5: {  // a corner that is not a number
      m.positions.push_back({std::numeric_limits<float>::quiet_NaN(), 0, 0});
      add(a, b, static_cast<std::uint32_t>(m.positions.size() - 1));
      break;
    }
    default: break;
    }
  }
  return m;
}

BodyDef fall(World& w, Solid kind, const Vec3& from, Chance& chance) {
  BodyDef d = solidBody(w, kind, 0.2, 1);
  d.pose = {from, chance.turn()}, d.v = 0.5 * chance.vector(), d.omega = 3 * chance.vector();
  d.surface = {0.5, 0.2, 0.05};
  return d;
}

TEST(DegenerateMesh, ASpoiltFloorCarriesEverySolid) {
  Chance chance(81);
  for (unsigned seed = 0; seed < 4; ++seed)
    for (const Solid kind : kSolids) {
      World w;
      const FieldId g = addGravity(w);
      const Mesh floor = spoilt(gridMesh(-5, 5, -5, 5, 12, 12), seed);
      const ColliderId c = w.addCollider({w.addShape(MeshShape(TriangleTree(floor))), {}, {0.5, 0.2, 0.05}});
      const BodyId b = addSolid(w, g, fall(w, kind, {0.3, 0.2, 0.8}, chance));
      Watch watch(w, {b});
      play(w, 4, watch);
      EXPECT_TRUE(watch.finite) << nameOf(kind) << seed;
      EXPECT_EQ(watch.limited, 0u) << nameOf(kind) << seed;
      EXPECT_LE(watch.greatestGain, 1e-4 * watch.first) << nameOf(kind) << seed;
      EXPECT_GT(w.state(b).p.z(), 0.05) << nameOf(kind) << seed;
      EXPECT_LE(std::fabs(w.separation({true, b}, {false, c})), 1e-3) << nameOf(kind) << seed;
    }
}

TEST(DegenerateMesh, NeedlesAreAGroundLikeAnyOther) {
  // A floor of triangles ten metres long and a millimetre wide, and of ones that are sharper still.
  for (const double width : {1e-2, 1e-3}) {
    Mesh m;
    for (int i = 0; i <= 60; ++i) {
      const auto y = static_cast<float>((i - 30) * width);
      m.positions.push_back({-5, y, 0}), m.positions.push_back({5, y, 0});
    }
    for (std::uint32_t i = 0; i < 60; ++i) {
      const std::uint32_t a = 2 * i;
      m.indices.insert(m.indices.end(), {a, a + 1, a + 2, a + 1, a + 3, a + 2});
    }
    Chance chance(82);
    for (const Solid kind : kSolids) {
      World w;
      const FieldId g = addGravity(w);
      w.addCollider({w.addShape(MeshShape(TriangleTree(m))), {}, {0.5, 0.2, 0.05}});
      w.addCollider({w.addShape(PlaneShape{}), {{0, 0, -1}, Quat::Identity()}, {0.5, 0.0, 0.05}});
      const BodyId b = addSolid(w, g, fall(w, kind, {0.1, 0, 0.5}, chance));
      Watch watch(w, {b});
      play(w, 0.6, watch);  // while all are above the strip
      EXPECT_TRUE(watch.finite) << nameOf(kind) << width;
      EXPECT_EQ(watch.limited, 0u) << nameOf(kind) << width;
      EXPECT_LE(watch.greatestGain, 1e-4 * watch.first) << nameOf(kind) << width;
      EXPECT_TRUE(width < 5e-3 || w.state(b).p.z() > 0.05) << nameOf(kind) << width;
    }
  }
}

TEST(DegenerateMesh, ASingleTriangleCarriesABallAndTurnsAwayOneFromBelow) {
  const Mesh one = meshOf({{-3, -3, 0}, {3, -3, 0}, {0, 4, 0}}, {{0, 1, 2}});
  for (const double side : {1.0, -1.0}) {
    World w;
    const FieldId g = addGravity(w, Vec3(0, 0, -side * kG));
    w.addCollider({w.addShape(MeshShape(TriangleTree(one))), {}, {0.5, 0.8, 0.0}});
    const BodyId b = addBall(w, g, {.p = {0, 0, side * 1.1}, .restitution = 0.8, .friction = 0.5});
    Watch watch(w, {b}, Vec3(0, 0, -side * kG));
    play(w, 0.75, watch);
    // It has bounced once, at 0.4515 s.
    const double fall = std::sqrt(2 / kG), t = 0.75 - fall;
    EXPECT_NEAR(side * w.state(b).p.z(), 0.1 + 0.8 * kG * fall * t - 0.5 * kG * t * t, 1e-9) << side;
    EXPECT_TRUE(watch.finite);
    play(w, 0, watch);
  }
}

TEST(DegenerateMesh, AFlatClosedMeshIsASheetWithTwoSides) {
  // Two triangles back to back, and a box without height: closed, but around nothing.
  const Mesh twice = meshOf({{-3, -3, 0}, {3, -3, 0}, {0, 4, 0}}, {{0, 1, 2}, {0, 2, 1}});
  for (const Mesh& flat : {twice, boxMesh({3, 3, 0})})
    for (const Solid kind : kSolids)
      for (const double side : {1.0, -1.0}) {
        if (kind == Solid::Mesh) continue;  // mesh against mesh knows no sides where there is no inside
        World w;
        const FieldId g = addGravity(w, Vec3(0, 0, -side * kG));
        TriangleTree tree(flat);
        ASSERT_FALSE(tree.empty());
        w.addCollider({w.addShape(MeshShape(std::move(tree))), {}, {0.5, 0.2, 0.05}});
        BodyDef d = solidBody(w, kind, 0.2, 1);
        d.pose.p = {0, 0, side * 0.6}, d.surface = {0.5, 0.2, 0.05};
        const BodyId b = addSolid(w, g, d);
        Watch watch(w, {b}, Vec3(0, 0, -side * kG));
        play(w, 2, watch);
        EXPECT_TRUE(watch.finite) << nameOf(kind) << side;
        EXPECT_EQ(watch.limited, 0u) << nameOf(kind) << side;
        EXPECT_GT(side * w.state(b).p.z(), 0.05) << nameOf(kind) << side;
        EXPECT_LE(watch.greatestGain, 1e-4 * watch.first) << nameOf(kind) << side;
      }
}

TEST(DegenerateMesh, WhatIsLeftOfASpoiltModelIsABodyLikeTheModel) {
  for (unsigned seed = 0; seed < 6; ++seed) {
    const Mesh model = boxMesh({0.3, 0.2, 0.1}), bad = spoilt(model, 90 + seed);
    for (const ShapeKind kind : {ShapeKind::Auto, ShapeKind::Convex, ShapeKind::Mesh}) {
      auto choice = chooseShape(bad, kind);
      ASSERT_TRUE(choice) << seed;
      EXPECT_TRUE(kind != ShapeKind::Auto || choice.value().kind == ShapeKind::Box) << choice.value().remark;
      World w;
      const FieldId g = addGravity(w);
      addFloor(w, 0.5, 0.2);
      BodyDef d;
      d.shape = w.addShape(std::move(choice.value().shape));
      ASSERT_NE(d.shape, 0u);
      d.mass = massOfMesh(model, 500).value();
      d.pose.p = {0, 0, 0.5}, d.surface = {0.5, 0.2, 0.0};
      const BodyId b = addSolid(w, g, d);
      Watch watch(w, {b});
      play(w, 3, watch);
      EXPECT_TRUE(watch.finite) << seed;
      EXPECT_EQ(watch.limited, 0u) << seed;
      EXPECT_NEAR(w.state(b).p.z(), 0.1, 1e-4) << seed;
      EXPECT_TRUE(w.state(b).asleep()) << seed;
    }
  }
}

TEST(DegenerateMesh, WithoutAUsableTriangleThereIsNoShapeAndAReasonInstead) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Mesh line = meshOf({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {{0, 1, 2}, {2, 1, 0}});
  const Mesh point = meshOf({{1, 1, 1}, {1, 1, 1}, {1, 1, 1}}, {{0, 1, 2}});
  const Mesh broken = meshOf({{0, 0, 0}, {1, 0, 0}, {nan, 1, 0}}, {{0, 1, 2}});
  for (const Mesh& m : {line, point, broken, Mesh{}}) {
    for (const ShapeKind kind :
         {ShapeKind::Auto, ShapeKind::Ball, ShapeKind::Box, ShapeKind::Convex, ShapeKind::Mesh}) {
      const auto choice = chooseShape(m, kind);
      ASSERT_FALSE(choice);
      EXPECT_FALSE(choice.error().message.empty());
    }
    EXPECT_FALSE(massOfMesh(m, 1));
    EXPECT_TRUE(TriangleTree(m).empty());
    World w;
    EXPECT_EQ(w.addShape(MeshShape(TriangleTree(m))), 0u);
  }
}

TEST(DegenerateMesh, AFlatOrSlenderModelStillFallsAndLies) {
  // A sheet of 20 cm, a needle of 1 m by 1 mm, a single triangle: as bodies, by the simplest shape.
  const std::array models{gridMesh(-0.1, 0.1, -0.1, 0.1, 2, 2), boxMesh({0.5, 5e-4, 5e-4}),
                          meshOf({{-0.1, -0.1, 0}, {0.1, -0.1, 0}, {0, 0.1, 0}}, {{0, 1, 2}})};
  for (std::size_t i = 0; i < models.size(); ++i) {
    for (const ShapeKind kind : {ShapeKind::Auto, ShapeKind::Mesh}) {
      auto choice = chooseShape(models[i], kind);
      ASSERT_TRUE(choice);
      World w;
      const FieldId g = addGravity(w);
      addFloor(w, 0.5, 0.1);
      BodyDef d;
      d.shape = w.addShape(std::move(choice.value().shape));
      d.mass = massOfBox({}, {0.1, 0.1, 0.01}, 1).withMass(0.1);
      d.pose = {{0, 0, 0.4}, Quat(Eigen::AngleAxisd(0.3, Vec3(1, 0.3, 0.2).normalized()))};
      d.surface = {0.5, 0.1, 0.0};
      const BodyId b = addSolid(w, g, d);
      if (b == 0) {  // planes are no bodies
        EXPECT_EQ(choice.value().kind, ShapeKind::Plane) << i;
        continue;
      }
      Watch watch(w, {b});
      play(w, 5, watch);
      EXPECT_TRUE(watch.finite) << i;
      EXPECT_EQ(watch.limited, 0u) << i;
      EXPECT_NEAR(w.state(b).p.z(), 0, 2e-3) << i << ' ' << choice.value().remark;
    }
  }
}

}  // namespace
}  // namespace stadion
