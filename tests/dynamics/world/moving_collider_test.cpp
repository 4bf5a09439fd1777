#include "engine/maths/functions.h"
#include "tests/dynamics/world/scenes.h"

#include <gtest/gtest.h>

namespace stadion {
namespace {

using namespace scenes;

/// A crude foot: a wedge of about the size of one.
Mesh footMesh() {
  return boxMesh({0.05, 0.14, 0.04});
}

TEST(MovingCollider, AWallThatMovesKicksARestingBallByItsOwnSpeed) {
  for (const double rate : {30.0, 60.0, 240.0}) {
    World w;
    const FieldId g = addGravity(w);
    addFloor(w, 0);
    const ColliderId wall = w.addCollider(
        {w.addShape(BoxShape{{}, {0.1, 1, 1}}), {{-1, 0, 1.1}, Quat::Identity()}, {0.0, 0.5, 0.0}});
    const BodyId b = addBall(w, g, {.p = {0, 0, 0.1}, .restitution = 0.5});
    double hitSpeed = 0, when = 0;
    // The wall walks at 2 m/s; its face meets the ball when it has gone 0.8 m.
    for (std::uint64_t i = 1; i <= static_cast<std::uint64_t>(rate); ++i) {
      const TimeSignature s = signatureAt(i, rate);
      w.moveCollider(wall, {{-1 + 2 * toSeconds(s.time), 0, 1.1}, Quat::Identity()});
      w.advance(s.time - s.step, s.time);
      for (const ContactEvent& e : w.events())
        if (e.kind == ContactEvent::Kind::Impact && e.other == ContactSide{false, wall})
          hitSpeed = e.speed, when = toSeconds(e.time);
    }
    EXPECT_NEAR(hitSpeed, 2, 1e-9);
    EXPECT_NEAR(when, 0.4, 2e-9);
    EXPECT_NEAR(w.state(b).v.x(), 3, 1e-9);
    EXPECT_NEAR(w.state(b).p.x(), 3 * 0.6, 1e-7) << rate;
  }
}

TEST(MovingCollider, AFootKicksTheBallOffTheGroundOnceAndReleasesIt) {
  World w;
  const FieldId g = addGravity(w);
  addFloor(w, 0.5, 0.5);
  const double pitch = 25 * M_PI / 180;
  const Quat q = det::fromEuler(pitch, 0, 0);
  const ColliderId foot =
      w.addCollider({w.addShape(MeshShape(TriangleTree(footMesh()))), {{0, -1, 0.12}, q}, {}});
  const BodyId b = addBall(w, g,
                           {.radius = 0.11,
                            .mass = 0.43,
                            .p = {0, 0, 0.11},
                            .restitution = 0.5,
                            .friction = 0.5,
                            .rolling = 0.01});
  int impacts = 0, releases = 0;
  double speed = 0;
  Nanoseconds hit = 0, free = 0;
  const auto frame = [&](std::uint64_t i) {
    const TimeSignature s = signatureAt(i, 60);
    const double t = toSeconds(s.time), y = t < 2 ? -1 : std::min(-1 + 6 * (t - 2), 0.3);
    w.moveCollider(foot, {{0, y, 0.12}, q});
    w.advance(s.time - s.step, s.time);
    for (const ContactEvent& e : w.events()) {
      if (e.other != ContactSide{false, foot}) continue;
      if (e.kind == ContactEvent::Kind::Impact) ++impacts, hit = e.time, speed = w.state(b).v.norm();
      if (e.kind == ContactEvent::Kind::Release) ++releases, free = e.time;
    }
  };
  for (std::uint64_t i = 1; i <= 120; ++i) {
    frame(i);
    EXPECT_TRUE(w.events().empty());
    EXPECT_LE((w.state(b).p - Vec3(0, 0, 0.11)).norm(), 1e-6);
  }
  for (std::uint64_t i = 121; i <= 240; ++i) frame(i);
  EXPECT_EQ(impacts, 1);
  EXPECT_EQ(releases, 1);
  EXPECT_GT(free, hit);
  std::printf("  foot: launch %.3f m/s\n", speed);
  EXPECT_GT(speed, 5);
  EXPECT_LT(speed, 10);
}

TEST(MovingCollider, AFootHitsFromEverySideAndNeverEndsUpInsideTheBall) {
  for (int k = 0; k < 40; ++k) {
    World w;
    const ColliderId foot =
        w.addCollider({w.addShape(MeshShape(TriangleTree(footMesh()))), {{0, 0, 5}, Quat::Identity()}, {}});
    const Vec3 from = Vec3(std::cos(2.4 * k), std::sin(2.4 * k), -1 + k / 20.0).normalized() * 0.8;
    const Quat q = det::expRotation(Vec3(0.3 * k, 1 - 0.1 * k, 0.05 * k));
    w.moveCollider(foot, {from, q}, true);
    const BodyId b = addBall(w, 0, {.radius = 0.11, .restitution = 0.5});
    int impacts = 0;
    for (std::uint64_t i = 1; i <= 30; ++i) {
      const TimeSignature s = signatureAt(i, 60);
      const double t = toSeconds(s.time);
      w.moveCollider(foot, {from * (1 - 4 * t), q * det::expRotation(Vec3(0, 0, 3 * t))});
      w.advance(s.time - s.step, s.time);
      for (const ContactEvent& e : w.events()) impacts += e.kind == ContactEvent::Kind::Impact;
      EXPECT_GE(w.separation({true, b}, {false, foot}), -1e-6) << k;
    }
    EXPECT_GE(impacts, 1) << k;
    EXPECT_GT(w.state(b).v.norm(), 1) << k;
  }
}

TEST(MovingCollider, ATeleportGivesNoImpulse) {
  World w;
  const ColliderId wall =
      w.addCollider({w.addShape(BoxShape{{}, {0.1, 1, 1}}), {{-1, 0, 0}, Quat::Identity()}, {}});
  const BodyId b = addBall(w, 0, {});
  play(w, 0.1);
  w.moveCollider(wall, {{1, 0, 0}, Quat::Identity()}, true);
  w.advance(signatureAt(6, 60).time, signatureAt(7, 60).time);
  EXPECT_EQ(w.state(b).v.norm(), 0);
  EXPECT_TRUE(w.events().empty());
}

TEST(MovingCollider, ATeleportIntoASleeperWakesIt) {
  World w;
  const FieldId g = addGravity(w);
  addFloor(w, 0.5);
  const ColliderId wall =
      w.addCollider({w.addShape(BoxShape{{}, {0.1, 1, 1}}), {{-5, 0, 1.5}, Quat::Identity()}, {}});
  const BodyId box =
      addBox(w, g, {.half = {0.1, 0.1, 0.1}, .pose = {{0, 0, 0.1}, Quat::Identity()}, .friction = 0.5});
  const BodyId ball = addBall(w, g, {.p = {0, 0.5, 0.1}, .friction = 0.5, .rolling = 0.05});
  play(w, 1);
  ASSERT_EQ(w.mode(box), BodyMode::Rest);
  ASSERT_EQ(w.mode(ball), BodyMode::Rest);
  w.moveCollider(wall, {{-0.15, 0, 1}, Quat::Identity()}, true);
  w.advance(fromSeconds(1), fromSeconds(1.5));
  EXPECT_GT(w.state(box).p.x(), 0.04) << "it was 5 cm inside";
  EXPECT_GT(w.state(ball).p.x(), 0.04);
}

TEST(MovingCollider, ABodyPutIntoASleeperWakesIt) {
  World w;
  const FieldId g = addGravity(w);
  addFloor(w, 0.5);
  const BodyId sleeper = addBall(w, g, {.p = {0, 0, 0.1}, .friction = 0.5, .rolling = 0.05});
  const BodyId other = addBall(w, g, {.p = {3, 0, 0.1}, .friction = 0.5, .rolling = 0.05});
  play(w, 1);
  ASSERT_EQ(w.mode(sleeper), BodyMode::Rest);
  w.placeBody(other, {{0.15, 0, 0.1}, Quat::Identity()}, Vec3::Zero(), Vec3::Zero());
  w.advance(fromSeconds(1), fromSeconds(1.5));
  EXPECT_LT(w.state(sleeper).p.x(), -0.01);
  EXPECT_GE(w.separation({true, sleeper}, {true, other}), -1e-3);
}

TEST(MovingCollider, ARestingBodyIsCarriedUpByALift) {
  World w;
  const FieldId g = addGravity(w);
  const ColliderId floor = w.addCollider(
      {w.addShape(BoxShape{{{0, 0, -0.1}, Quat::Identity()}, {1, 1, 0.1}}), {}, {0.5, 0.0, 0.0}});
  const BodyId box =
      addBox(w, g, {.half = {0.1, 0.1, 0.1}, .pose = {{0.5, 0, 0.1}, Quat::Identity()}, .friction = 0.5});
  const BodyId ball = addBall(w, g, {.p = {-0.5, 0, 0.1}, .friction = 0.5, .rolling = 0.05});
  for (std::uint64_t i = 1; i <= 180; ++i) {
    const TimeSignature s = signatureAt(i, 60);
    w.moveCollider(floor, {{0, 0, std::clamp(toSeconds(s.time) - 1, 0.0, 1.0)}, Quat::Identity()});
    w.advance(s.time - s.step, s.time);
  }
  EXPECT_NEAR(w.state(box).p.z(), 1.1, 2e-3);
  EXPECT_NEAR(w.state(ball).p.z(), 1.1, 2e-3);
}

}  // namespace
}  // namespace stadion
