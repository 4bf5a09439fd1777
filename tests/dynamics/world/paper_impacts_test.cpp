/// The contact scheme of the paper: how near it comes to closed forms, and what it misses by design.

#include "dynamics/world/world.h"
#include "engine/maths/functions.h"
#include "tests/dynamics/world/scenes.h"

#include <gtest/gtest.h>

namespace stadion {
namespace {

using namespace scenes;

constexpr double kTolerances[] = {1e-3, 1e-5, 1e-7};

ImpactScheme paper(double tolerance, double rate = 60) {
  return {ImpactScheme::Kind::Paper, tolerance, 1 / rate};
}

/// The times of all impacts.
std::vector<double> impactsOf(World& w, double seconds, double rate = 60) {
  std::vector<double> times;
  play(w, seconds, rate, [&](double) {
    for (const ContactEvent& e : w.events())
      if (e.kind == ContactEvent::Kind::Impact) times.push_back(toSeconds(e.time));
  });
  return times;
}

ColliderId addStill(World& w, const Mesh& mesh, const Pose& at = {},
                    const Surface& surface = {0.0, 0.0, 0.0}) {
  return w.addCollider({w.addShape(MeshShape(TriangleTree(mesh))), at, surface});
}

enum class PaperGround { Plane, Sheet, Box, Mesh };

void addGround(World& w, PaperGround kind, double restitution = 0) {
  const Surface s{0.0, restitution, 0.0};
  switch (kind) {
  case PaperGround::Plane: addFloor(w, 0, restitution); break;
  case PaperGround::Sheet: w.addCollider({w.addShape(PlaneShape{{}, Vec2(3, 3)}), {}, s}); break;
  case PaperGround::Box:
    w.addCollider({w.addShape(BoxShape{{Vec3(0, 0, -0.5), Quat::Identity()}, Vec3(3, 3, 0.5)}), {}, s});
    break;
  case PaperGround::Mesh: addStill(w, gridMesh(-3, 3, -3, 3, 5, 5), {}, s); break;
  }
}

TEST(PaperImpacts, ABallTouchesNoLaterThanItShouldAndEarlyByTheToleranceAtMost) {
  const double height = 1.3, exact = std::sqrt(2 * height / kG), speed = kG * exact;
  for (const PaperGround ground :
       {PaperGround::Plane, PaperGround::Sheet, PaperGround::Box, PaperGround::Mesh})
    for (const double tolerance : kTolerances) {
      World w;
      w.setImpactScheme(paper(tolerance));
      addGround(w, ground, 0.5);
      BallSpec ball;
      ball.p = Vec3(0.1, 0.2, height + ball.radius), ball.restitution = 0.5;
      addBall(w, addGravity(w), ball);
      const std::vector<double> times = impactsOf(w, 0.6);
      ASSERT_EQ(times.size(), 1u) << static_cast<int>(ground) << " " << tolerance;
      EXPECT_LE(times[0], exact + 2e-9) << static_cast<int>(ground) << " " << tolerance;
      EXPECT_GE(times[0], exact - 1.01 * tolerance / speed - 2e-9)
          << static_cast<int>(ground) << " " << tolerance;
    }
}

TEST(PaperImpacts, ABoxThatFallsFlatLandsFlatHoweverEarlyItTouches) {
  for (const double tolerance : kTolerances) {
    World w;
    w.setImpactScheme(paper(tolerance));
    addStill(w, gridMesh(-5, 5, -5, 5, 10, 10), {}, {0.5, 0.0, 0.0});
    BodyDef d;
    d.shape = w.addShape(BoxShape{{}, Vec3::Constant(0.1)});
    d.pose.p = Vec3(-2, 4, 0.5);
    d.mass = massOfBox({}, Vec3::Constant(0.1), 1);
    d.surface = {0.5, 0.0, 0.0};
    const BodyId id = w.addBody(d);
    w.hook(id, addGravity(w), 0);
    double turned = 0;
    play(w, 2, 60, [&](double) { turned = std::max(turned, w.state(id).omega.norm()); });
    EXPECT_LT(turned, 1e-6) << tolerance;
    EXPECT_EQ(w.state(id).mode, BodyMode::Rest) << tolerance;
    EXPECT_NEAR(w.pose(id).p.z(), 0.1, 1e-5) << tolerance;
  }
}

TEST(PaperImpacts, AMeshOnAMeshIsBracketedByItsBoxes) {
  const double height = 0.9, exact = std::sqrt(2 * height / kG), speed = kG * exact;
  for (const double tolerance : kTolerances) {
    World w;
    w.setImpactScheme(paper(tolerance));
    addStill(w, gridMesh(-3, 3, -3, 3, 7, 7));
    BodyDef d;
    d.shape = w.addShape(MeshShape(TriangleTree(boxMesh(Vec3(0.1, 0.2, 0.3)))));
    d.pose.p = Vec3(0.03, 0.02, 0.3 + height);
    d.mass = massOfBox({}, Vec3(0.1, 0.2, 0.3), 1);
    w.hook(w.addBody(d), addGravity(w), 0);
    const std::vector<double> times = impactsOf(w, 0.5);
    ASSERT_FALSE(times.empty()) << tolerance;
    EXPECT_LE(times[0], exact + 2e-9) << tolerance;
    EXPECT_GE(times[0], exact - 1.01 * tolerance / speed - 2e-9) << tolerance;
  }
}

TEST(PaperImpacts, AColliderThatMovesIsMetWhereItHasComeTo) {
  for (const double tolerance : kTolerances) {
    World w;
    w.setImpactScheme(paper(tolerance));
    BallSpec ball;
    ball.p = Vec3(0, 0, 2), ball.restitution = 1;
    const BodyId id = addBall(w, 0, ball);
    const ColliderId lift =
        addStill(w, boxMesh(Vec3::Constant(0.5)), {Vec3::Zero(), Quat::Identity()}, {0.0, 1.0, 0.0});
    double hit = 0;
    for (std::uint64_t n = 1; n <= 60; ++n) {
      const TimeSignature s = signatureAt(n, 60);
      w.moveCollider(lift, {Vec3(0, 0, 3 * toSeconds(s.time)), Quat::Identity()});
      w.advance(s.time - s.step, s.time);
      for (const ContactEvent& e : w.events())
        if (e.kind == ContactEvent::Kind::Impact && hit == 0) hit = toSeconds(e.time);
    }
    const double exact = (2 - 0.1 - 0.5) / 3;
    EXPECT_LE(hit, exact + 2e-9) << tolerance;
    EXPECT_GE(hit, exact - 1.01 * tolerance / 3 - 2e-9) << tolerance;
    EXPECT_NEAR(w.state(id).v.z(), 6, 1e-9) << tolerance;
  }
}

TEST(PaperImpacts, BouncesWithoutLossKeepTheirEnergy) {
  for (const PaperGround ground : {PaperGround::Plane, PaperGround::Mesh}) {
    World w;
    w.setImpactScheme(paper(1e-3));
    addGround(w, ground, 1);
    BallSpec ball;
    ball.p = Vec3(0.1, 0.2, 1 + ball.radius), ball.restitution = 1;
    const BodyId id = addBall(w, addGravity(w), ball);
    const auto energy = [&] { return w.kineticEnergy(id) + kG * w.pose(id).p.z(); };
    const double before = energy();
    EXPECT_GT(impactsOf(w, 20).size(), 18u);
    EXPECT_NEAR(energy(), before, 1e-9) << static_cast<int>(ground);
  }
}

TEST(PaperImpacts, ABounceThatRisesLessThanTheToleranceIsTheLast) {
  for (const PaperGround ground : {PaperGround::Plane, PaperGround::Box, PaperGround::Mesh})
    for (const double tolerance : {1e-3, 1e-5}) {
      World w;
      w.setImpactScheme(paper(tolerance));
      addGround(w, ground, 0.5);
      BallSpec ball;
      ball.p = Vec3(0.1, 0.2, 0.5), ball.restitution = 0.5;
      const BodyId id = addBall(w, addGravity(w), ball);
      play(w, 4);
      EXPECT_TRUE(standsStill(w.mode(id))) << static_cast<int>(ground) << " " << tolerance;
      EXPECT_NEAR(w.pose(id).p.z(), 0.1, 1e-9) << static_cast<int>(ground) << " " << tolerance;
    }
}

TEST(PaperImpacts, BoxesAndMeshesComeToRest) {
  for (const bool mesh : {false, true}) {
    World w;
    w.setImpactScheme(paper(1e-3));
    addFloor(w, 0.5, 0.2);
    const FieldId g = addGravity(w);
    BodyDef d;
    const Vec3 half(0.1, 0.15, 0.2);
    d.shape = mesh ? w.addShape(MeshShape(TriangleTree(boxMesh(half)))) : w.addShape(BoxShape{{}, half});
    d.pose = {Vec3(0, 0, 0.8), det::expRotation(Vec3(0.5, 0.3, 0.1))};
    d.mass = massOfBox({}, half, 1), d.surface = {0.5, 0.2, 0.0};
    const BodyId id = w.addBody(d);
    w.hook(id, g, 0);
    play(w, 6);
    EXPECT_TRUE(standsStill(w.mode(id))) << mesh;
    double lowest = 1;
    for (int i = 0; i < 8; ++i)
      lowest = std::min(lowest, (w.pose(id) * Vec3((i & 1 ? 1 : -1) * half.x(), (i & 2 ? 1 : -1) * half.y(),
                                                   (i & 4 ? 1 : -1) * half.z()))
                                    .z());
    EXPECT_NEAR(lowest, 0, 1e-4) << mesh;
    EXPECT_EQ(w.counters().limited, 0u) << mesh;
  }
}

/// By design: both ends of the step are free.
TEST(PaperImpacts, WhatPassesAThinWallWithinAStepIsNotSeen) {
  const auto endsBeyond = [](const ImpactScheme& scheme) {
    World w;
    w.setImpactScheme(scheme);
    w.addCollider({w.addShape(BoxShape{{}, Vec3(0.0005, 1, 1)}), {}, {0.0, 1.0, 0.0}});
    BallSpec ball;
    ball.radius = 0.02, ball.p = Vec3(-0.9, 0, 0), ball.v = Vec3(100, 0, 0), ball.restitution = 1;
    const BodyId id = addBall(w, 0, ball);
    play(w, 0.1);
    return w.pose(id).p.x() > 0;
  };
  EXPECT_FALSE(endsBeyond({}));
  EXPECT_TRUE(endsBeyond(paper(1e-5)));
  EXPECT_FALSE(endsBeyond(paper(1e-5, 10000)));
}

TEST(PaperImpacts, AreTheSameAtEveryFrameRate) {
  const auto timesAt = [](double rate) {
    World w;
    w.setImpactScheme(paper(1e-4));
    addGround(w, PaperGround::Mesh, 0.6);
    const FieldId g = addGravity(w);
    for (int i = 0; i < 4; ++i) {
      BallSpec ball;
      ball.p = Vec3(0.17 * i - 0.3, 0.02 * i, 0.4 + 0.3 * i), ball.restitution = 0.6;
      addBall(w, g, ball);
    }
    return impactsOf(w, 2, rate);
  };
  const std::vector<double> at60 = timesAt(60);
  EXPECT_GT(at60.size(), 8u);
  EXPECT_EQ(timesAt(30), at60);
  EXPECT_EQ(timesAt(144), at60);
}

}  // namespace
}  // namespace stadion
