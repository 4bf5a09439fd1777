/// Bodies in a hand: what they do to others, and how they leave it.

#include "engine/maths/functions.h"
#include "tests/dynamics/nodes/show_nodes.h"
#include "tests/dynamics/world/watch.h"

#include <gtest/gtest.h>

namespace stadion {
namespace {

using namespace scenes;

/// Carries a held body along `way(t)` from frame to frame.
template <class Way>
void carry(World& w, BodyId held, double from, double to, double rate, Way way) {
  for (auto n = static_cast<std::uint64_t>(from * rate + 0.5) + 1;
       toSeconds(signatureAt(n, rate).time) <= to + 1e-9; ++n) {
    const TimeSignature s = signatureAt(n, rate);
    w.moveHeld(held, way(toSeconds(s.time)));
    w.advance(s.time - s.step, s.time);
  }
}

TEST(GrabAndThrow, WhatAHeldBodyHitsGetsMomentumAsFromAWallOfItsSpeed) {
  for (const Solid kind : kSolids)
    for (const double mass : {0.01, 1.0, 100.0})
      for (const double rate : {30., 144.}) {
        World w;
        const BodyId hand = addBox(
            w, 0, {.half = Vec3::Constant(0.3), .pose = {{-1, 0, 0}, Quat::Identity()}, .restitution = 0.5});
        BodyDef d = solidBody(w, kind, 0.2, mass);
        d.surface = {0.0, 0.5, 0.0};
        const BodyId hit = w.addBody(d);
        w.advance(0, 0);
        ASSERT_TRUE(w.holdBody(hand));
        carry(w, hand, 0, 0.5, rate, [](double t) { return Pose{{-1 + 2 * t, 0, 0}, Quat::Identity()}; });
        EXPECT_NEAR(w.state(hit).v.x(), 3, 1e-6) << nameOf(kind) << mass;
        EXPECT_NEAR(w.pose(hand).p.x(), 0, 1e-12) << "the hand goes where it goes";
      }
}

TEST(GrabAndThrow, AHeldBatHitsWithTheSpeedOfThePointThatHits) {
  // A bat of 1 m turns about its end at 5 rad/s; the ball is met at a lever of 0.8 m, square on.
  for (const double rate : {30., 60., 240.}) {
    World w;
    const double omega = 5, lever = 0.8, thick = 0.02, r = 0.05;
    const auto way = [&](double t) {
      const Quat q = det::expRotation(Vec3(0, 0, omega * t - 1));
      return Pose{q * Vec3(0.5, 0, 0), q};
    };
    const BodyId bat = addBox(w, 0, {.half = {0.5, thick, 0.05}, .pose = way(0), .restitution = 0.8});
    const BodyId ball =
        addBall(w, 0, {.radius = r, .mass = 0.1, .p = {lever, thick + r, 0}, .restitution = 0.8});
    w.advance(0, 0);
    ASSERT_TRUE(w.holdBody(bat));
    carry(w, bat, 0, 0.25, rate, way);
    // Square on at angle 0; frames cut the way into chords, so the bat's middle lags by (omega dt)^2 / 8 of
    // 0.5 m.
    const double chord = 0.5 * omega * omega / rate / rate / 8 * 40;
    EXPECT_NEAR(w.state(ball).v.norm(), 1.8 * omega * lever, 0.01 + chord) << rate;
  }
}

using Field = show_nodes::Field;
using Ball = show_nodes::Ball;
using Sim = show_nodes::Sim;

/// A ball held from 0.2 s on by a wand that goes along `x(t)`, let go at 0.8 s, seen at 1 s.
template <class Way>
BodyState thrown(double rate, Way x, const Vec3& push = Vec3::Zero()) {
  ShowFixture show;
  show.rate = rate;
  Ball* ball = nullptr;
  show.loader.files["show"] = [&](LoadedScene& load) {
    addNode<Field>(load, "wind", push, true);
    ball = &addNode<Ball>(load, "ball", Vec3(0, 0, 1), std::vector<std::string>{"wind"});
    addNode<Sim>(load, "sim", std::vector<std::string>{}, std::vector<std::string>{"ball"});
  };
  show.scene.open("show");
  const auto until = [&](double seconds) {
    while (toSeconds(signatureAt(show.next, rate).time) <= seconds + 1e-9) {
      show.tracker("wand", x(toSeconds(signatureAt(show.next, rate).time)));
      show.frame();
    }
  };
  until(0.2);
  show.scene.command("ball", CommandId::Grab, {"wand"}, show.input.time);
  until(0.8);
  show.scene.command("ball", CommandId::Release, {}, show.input.time);
  until(1);
  return ball->state();
}

TEST(GrabAndThrow, AThrowHasTheSlopeOfTheHandsLastEightyMilliseconds) {
  // The hand starts at 0.4 s and speeds up at 5 m/s2: the line through its last 80 ms has the slope of their
  // middle.
  const auto way = [](double t) {
    const double s = std::max(0.0, t - 0.4);
    return Vec3(0, 2.5 * s * s, 1);
  };
  for (const double rate : {30., 60., 144., 240.}) {
    const BodyState s = thrown(rate, way);
    EXPECT_NEAR(s.v.y(), 5 * (0.4 - 0.04), 0.02) << rate;
    EXPECT_NEAR(s.v.x(), 0, 1e-12);
  }
}

TEST(GrabAndThrow, OnReleaseTheFieldsPushAgain) {
  const auto still = [](double) { return Vec3(0, 0, 1); };
  const BodyState s = thrown(60, still, {3, 0, 0});
  // It has been pushed from 0.8 s on; before, as long as no hand held it, for 0.2 s.
  EXPECT_NEAR(s.v.x(), 3 * 0.2, 3 * 0.02);
  EXPECT_NEAR(s.v.y(), 0, 1e-9);
}

/// What the held body is let go inside of.
enum class Into { Plane, Box, Mesh, Dome };

TEST(GrabAndThrow, LetGoInsideSomethingItComesOutWithoutAJump) {
  for (const Into into : {Into::Plane, Into::Box, Into::Mesh, Into::Dome})
    for (const Solid kind : {Solid::Ball, Solid::Box, Solid::Cylinder, Solid::Convex})
      for (const double depth : {0.01, 0.06}) {
        World w;
        const FieldId g = addGravity(w);
        ColliderId c = 0;
        switch (into) {
        case Into::Plane: c = addFloor(w, 0.5); break;
        case Into::Box:
          c = w.addCollider(
              {w.addShape(BoxShape{{{0, 0, -1}, Quat::Identity()}, {3, 3, 1}}), {}, {0.5, 0.0, 0.0}});
          break;
        case Into::Mesh:
          c = w.addCollider({w.addShape(MeshShape(TriangleTree(boxMesh({3, 3, 1})))),
                             {{0, 0, -1}, Quat::Identity()},
                             {0.5, 0.0, 0.0}});
          break;
        case Into::Dome:
          c = w.addCollider({w.addShape(BallShape{{0, 0, -1}, 1}), {}, {0.5, 0.0, 0.0}});
          break;
        }
        BodyDef d = solidBody(w, kind, 0.2, 1);
        d.pose.p = {0, 0, 1}, d.surface = {0.5, 0.0, 0.0};
        const BodyId b = addSolid(w, g, d);
        w.advance(0, 0);
        ASSERT_TRUE(w.holdBody(b));
        const double half = kind == Solid::Ball       ? 0.2
                            : kind == Solid::Cylinder ? 0.06
                                                      : 0.12,
                     end = half - depth;
        carry(w, b, 0, 1, 60, [&](double t) { return Pose{{0, 0, 1 + (end - 1) * t}, Quat::Identity()}; });
        const std::string what = std::string(nameOf(kind)) + " in " + std::to_string(static_cast<int>(into)) +
                                 " by " + std::to_string(depth);
        ASSERT_NEAR(w.separation({true, b}, {false, c}), -depth, 0.01) << what;
        ASSERT_TRUE(w.releaseBody(b, Vec3::Zero(), Vec3::Zero()));
        Vec3 last = w.state(b).p;
        double longest = 0;
        Watch watch(w, {b});
        for (std::uint64_t n = 61; n <= 120; ++n) {
          const TimeSignature s = signatureAt(n, 60);
          w.advance(s.time - s.step, s.time);
          watch.look();
          longest = std::max(longest, (w.state(b).p - last).norm());
          last = w.state(b).p;
        }
        EXPECT_TRUE(watch.finite) << what;
        EXPECT_LE(longest, 0.02) << what << ": 1 m/s is no jump";
        EXPECT_LE(watch.fastest, 1.2) << what;
        EXPECT_GE(w.separation({true, b}, {false, c}), -1e-3) << what;
      }
}

}  // namespace
}  // namespace stadion
