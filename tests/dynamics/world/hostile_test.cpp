#include "engine/maths/functions.h"
#include "tests/dynamics/world/scenes.h"

#include <gtest/gtest.h>

namespace stadion {
namespace {

using namespace scenes;

TEST(Hostile, BadArgumentsAreRefused) {
  World w;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(w.addShape(BallShape{Vec3::Zero(), -1}), 0u);
  EXPECT_EQ(w.addShape(BallShape{Vec3(nan, 0, 0), 1}), 0u);
  BodyDef d;
  EXPECT_EQ(w.addBody(d), 0u);
  d.shape = w.addShape(BallShape{});
  d.pose.p.x() = nan;
  EXPECT_EQ(w.addBody(d), 0u);
  d.pose = {};
  d.mass.mass = 0;
  EXPECT_EQ(w.addBody(d), 0u);
  d.mass.mass = 1;
  d.surface.restitution = 2;
  EXPECT_EQ(w.addBody(d), 0u);
  d.surface = {};
  const BodyId b = w.addBody(d);
  EXPECT_NE(b, 0u);
  EXPECT_FALSE(w.removeShape(d.shape));
  EXPECT_FALSE(w.hook(b, 77, 0));
  EXPECT_FALSE(w.moveCollider(3, {}));
  EXPECT_FALSE(w.placeBody(b, {Vec3(nan, 0, 0), Quat::Identity()}, Vec3::Zero(), Vec3::Zero()));
  EXPECT_TRUE(w.advance(0, 1000));
  EXPECT_FALSE(w.advance(1000, 500));
  EXPECT_FALSE(w.advance(5000, 6000));
  EXPECT_TRUE(w.removeBody(b));
  EXPECT_TRUE(w.removeShape(d.shape));
}

TEST(Hostile, ABrokenFloorStillCarries) {
  Mesh m = gridMesh(-5, 5, -5, 5, 10, 10);
  const auto indices = m.indices;
  for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
    if (i % 15 == 0) m.indices.insert(m.indices.end(), {indices[i], indices[i], indices[i + 1]});
    if (i % 21 == 0) m.indices.insert(m.indices.end(), {indices[i], indices[i + 1], indices[i + 2]});
    if (i % 33 == 0) {
      m.positions.push_back(m.positions[indices[i]]);
      m.indices.insert(m.indices.end(),
                       {static_cast<std::uint32_t>(m.positions.size() - 1), indices[i + 1], indices[i + 2]});
    }
  }
  World w;
  const FieldId g = addGravity(w);
  w.addCollider({w.addShape(MeshShape(TriangleTree(m))), {}, {0.5, 0.0, 0.0}});
  std::vector<BodyId> bodies;
  for (int i = 0; i < 25; ++i) {
    const Vec3 p(-4 + 2.0 * (i % 5), -4 + 2.0 * (i / 5), 0.5);
    bodies.push_back(
        i % 2 ? addBox(w, g, {.half = Vec3::Constant(0.1), .pose = {p, Quat::Identity()}, .friction = 0.5})
              : addBall(w, g, {.p = p, .friction = 0.5}));
  }
  play(w, 5);
  for (const BodyId b : bodies) EXPECT_NEAR(w.state(b).p.z(), 0.1, 2e-3) << b;
}

TEST(Hostile, GreatSpeedsArriveWhereTheyShould) {
  World w;
  addFloor(w, 0, 0.5);
  const BodyId a = addBall(w, 0, {.p = {0, 0, 3}, .v = {0, 0, -1e5}, .restitution = 0.5});
  const BodyId b = addBall(w, 0, {.p = {0, 0, 5}, .v = {1e6, 0, 0}});
  play(w, 1);
  EXPECT_NEAR(w.state(a).v.z(), 5e4, 1e-3);
  EXPECT_NEAR(w.state(b).p.x() / 1e6, 1, 1e-12);
}

TEST(Hostile, CoincidentBodiesNeverExplode) {
  World w;
  const FieldId g = addGravity(w);
  addFloor(w, 0.5);
  std::vector<BodyId> all;
  for (int i = 0; i < 2; ++i) all.push_back(addBall(w, g, {.p = {0, 0, 1}, .friction = 0.5}));
  for (int i = 0; i < 2; ++i)
    all.push_back(
        addBox(w, g, {.half = Vec3::Constant(0.1), .pose = {{3, 0, 1}, Quat::Identity()}, .friction = 0.5}));
  play(w, 3, 60, [&](double) {
    for (const BodyId b : all) {
      EXPECT_TRUE(w.pose(b).finite());
      EXPECT_LE(w.state(b).v.norm(), 12);
      EXPECT_GE(w.state(b).p.z(), 0);
    }
  });
}

TEST(Hostile, ASpinningDiscAtThreeHundredRadiansPerSecondBouncesOffAThinWall) {
  for (const Vec3& omega : {Vec3(0, 0, 40), Vec3(40, 0, 0), Vec3(0, 300, 0)}) {
    for (int phase = 0; phase < 4; ++phase) {
      World w;
      w.addCollider({w.addShape(BoxShape{{}, {0.0005, 10, 10}}), {}, {0.0, 0.5, 0.0}});
      const BodyId b = addBox(w, 0,
                              {.half = {0.11, 0.11, 0.012},
                               .mass = 2,
                               .pose = {{-1 - 0.06 * phase, 0.3, 0}, Quat::Identity()},
                               .v = {30, 0, 0},
                               .omega = omega,
                               .restitution = 0.5});
      play(w, 0.3);
      EXPECT_LT(w.state(b).p.x(), 0) << omega.transpose() << " " << phase;
      EXPECT_TRUE(w.pose(b).finite());
    }
  }
}

TEST(Hostile, ALightBoxUnderATenThousandTimesHeavierOneHolds) {
  World w;
  const FieldId g = addGravity(w);
  addFloor(w, 0.5);
  addBox(
      w, g,
      {.half = Vec3::Constant(0.1), .mass = 1e-1, .pose = {{0, 0, 0.1}, Quat::Identity()}, .friction = 0.5});
  const BodyId top = addBox(
      w, g,
      {.half = Vec3::Constant(0.1), .mass = 1e3, .pose = {{0, 0, 0.3}, Quat::Identity()}, .friction = 0.5});
  play(w, 3);
  EXPECT_NEAR(w.state(top).p.z(), 0.3, 1e-2);
}

TEST(Hostile, TwoRunsAreTheSameToTheBit) {
  const auto run = [] {
    World w;
    const FieldId g = addGravity(w);
    addFloor(w, 0.5, 0.4);
    std::vector<BodyId> all;
    for (int i = 0; i < 12; ++i) {
      const Vec3 p(0.15 * (i % 3), 0.12 * (i % 2), 0.5 + 0.35 * i);
      all.push_back(i % 3 ? addBall(w, g, {.p = p, .restitution = 0.4, .friction = 0.5, .rolling = 0.01})
                          : addBox(w, g,
                                   {.half = {0.1, 0.15, 0.1},
                                    .pose = {p, det::fromEuler(0.1 * i, 0.2, 0)},
                                    .restitution = 0.3,
                                    .friction = 0.5}));
    }
    play(w, 4);
    std::vector<double> out;
    for (const BodyId b : all) {
      const BodyState s = w.state(b);
      for (const double x : {s.p.x(), s.p.y(), s.p.z(), s.q.w(), s.v.x(), s.L.y()}) out.push_back(x);
      EXPECT_GT(s.p.z(), 0) << b;
    }
    return out;
  };
  EXPECT_EQ(run(), run());
}

}  // namespace
}  // namespace stadion
