#include "tests/dynamics/world/scenes.h"

#include <gtest/gtest.h>
#include <limits>

namespace stadion {
namespace {

using namespace scenes;

TEST(World, AHeldBodyPushesOthersAndFliesOnWhenLetGo) {
  World w;
  const BodyId hand =
      addBox(w, 0, {.half = Vec3::Constant(0.1), .pose = {{-1, 0, 0}, Quat::Identity()}, .restitution = 0.5});
  const BodyId ball = addBall(w, 0, {.restitution = 0.5});
  w.advance(0, 0);
  ASSERT_TRUE(w.holdBody(hand));
  for (std::uint64_t i = 1; i <= 60; ++i) {
    const TimeSignature s = signatureAt(i, 60);
    w.moveHeld(hand, {{-1 + 2 * toSeconds(s.time), 0, 0}, Quat::Identity()});
    w.advance(s.time - s.step, s.time);
    EXPECT_NEAR(w.pose(hand).p.x(), -1 + 2 * toSeconds(s.time), 1e-12);
  }
  EXPECT_NEAR(w.state(ball).v.x(), 3, 1e-9);
  ASSERT_TRUE(w.releaseBody(hand, {0, 4, 0}, Vec3::Zero()));
  const TimeSignature s = signatureAt(61, 60);
  w.advance(s.time - s.step, s.time);
  EXPECT_NEAR(w.pose(hand).p.y(), 4 * toSeconds(s.step), 1e-9);
}

TEST(World, SleepersFallWhenWhatCarriesThemIsTakenAway) {
  World w;
  const FieldId g = addGravity(w);
  const ColliderId floor = addFloor(w, 0.5);
  const BodyId low =
      addBox(w, g, {.half = Vec3::Constant(0.1), .pose = {{0, 0, 0.1}, Quat::Identity()}, .friction = 0.5});
  const BodyId high =
      addBox(w, g, {.half = Vec3::Constant(0.1), .pose = {{0, 0, 0.3}, Quat::Identity()}, .friction = 0.5});
  const BodyId ball = addBall(w, g, {.p = {2, 0, 0.1}, .friction = 0.5});
  play(w, 1);
  ASSERT_EQ(w.mode(high), BodyMode::Rest);
  ASSERT_EQ(w.mode(ball), BodyMode::Rest);
  w.removeBody(low);
  const Nanoseconds second = 1'000'000'000;
  w.advance(second, second + second / 10);
  EXPECT_NEAR(w.state(high).p.z(), 0.3 - 0.5 * kG * 0.01, 5e-3);
  w.enableCollider(floor, false);
  w.advance(second + second / 10, 2 * second);
  EXPECT_LT(w.state(ball).p.z(), -3);
}

TEST(World, AResetFieldWakesASleeper) {
  World w;
  const FieldId g = addGravity(w);
  addFloor(w, 0.5);
  const BodyId b =
      addBox(w, g, {.half = Vec3::Constant(0.1), .pose = {{0, 0, 0.1}, Quat::Identity()}, .friction = 0.5});
  ForceField f;
  f.law = LinearField{{0, 0, 3 * kG}, LinearField::Unit::Acceleration};
  const FieldId lift = w.addField(f);
  w.hook(b, lift, 0);
  w.switchField(lift, true, 1'000'000'000);
  w.switchField(lift, false, 1'250'000'000);
  play(w, 1.2);
  EXPECT_NEAR(w.state(b).p.z(), 0.1 + 0.5 * 2 * kG * 0.04, 1e-6);
}

TEST(World, ImpactsFireOncePerTouchAndReleasesOnceEach) {
  World w;
  const FieldId g = addGravity(w);
  const ColliderId floor = addFloor(w, 0.5, 0.9);
  const BodyId b = addBall(w, g, {.p = {0, 0, 1.1}, .restitution = 0.9});
  int impacts = 0, releases = 0;
  bool due = false;
  play(w, 20, 60, [&](double) {
    bool fired = false;
    for (const ContactEvent& e : w.events()) {
      EXPECT_EQ(e.other, (ContactSide{false, floor}));
      EXPECT_EQ(e.body, b);
      if (e.kind == ContactEvent::Kind::Impact) {
        ++impacts, due = fired = true;
        EXPECT_GT(e.speed, 0.05);
        EXPECT_NEAR(e.normal.z(), 1, 1e-12);
        EXPECT_NEAR(e.impulse, 1.9 * e.speed, 1e-9);
      } else {
        ++releases;
        EXPECT_TRUE(due);
        EXPECT_FALSE(fired);
        due = false;
      }
    }
  });
  // Bounces rise above half a metre while 0.81^k > 0.5; closing speeds stay above 0.05 m/s while 4.43 * 0.9^k
  // > 0.05.
  EXPECT_EQ(releases, 3);
  EXPECT_EQ(impacts, 1 + static_cast<int>(std::log(0.05 / std::sqrt(2 * kG)) / std::log(0.9)));
}

TEST(World, ReleasesAreToldToTheNanosecondAtAnyFrameRateOverPlanesBoxesAndMeshes) {
  const double fall = std::sqrt(2 / kG), v = kG * fall;
  const double rise = (v - std::sqrt(v * v - 2 * kG * 0.5)) / kG;  // until it is half a metre up
  Mesh sheet;
  sheet.positions = {{-9, -9, 0}, {9, -9, 0}, {9, 9, 0}, {-9, 9, 0}};
  sheet.indices = {0, 1, 2, 0, 2, 3};
  for (const int kind : {0, 1, 2})
    for (const double rate : {30., 96., 240.}) {
      World w;
      const FieldId g = addGravity(w);
      const ShapeId shape = kind == 0   ? w.addShape(PlaneShape{})
                            : kind == 1 ? w.addShape(BoxShape{{{0, 0, -1}, Quat::Identity()}, {9, 9, 1}})
                                        : w.addShape(MeshShape(TriangleTree(sheet)));
      w.addCollider({shape, {}, {0.5, 1.0, 0.0}});
      addBall(w, g, {.p = {0.3, 0.1, 1.1}, .v = {2, 0, 0}, .restitution = 1});
      std::vector<Nanoseconds> releases;
      play(w, 3, rate, [&](double) {
        for (const ContactEvent& e : w.events())
          if (e.kind == ContactEvent::Kind::Release) releases.push_back(e.time);
      });
      ASSERT_EQ(releases.size(), 3u) << kind << ' ' << rate;
      for (std::size_t k = 0; k < 3; ++k)
        EXPECT_NEAR(static_cast<double>(releases[k]), 1e9 * (fall * (2 * static_cast<double>(k) + 1) + rise),
                    1.0);
    }
}

TEST(World, ReleasesWithoutListenersAreNotReportedAndChangeNothingElse) {
  std::vector<Nanoseconds> impacts[2];
  BodyState end[2];
  for (const bool asked : {true, false}) {
    World w;
    const FieldId g = addGravity(w);
    w.addCollider({w.addShape(BoxShape{{{0, 0, -1}, Quat::Identity()}, {9, 9, 1}}), {}, {0.5, 0.8, 0.0}});
    BodyDef d;
    d.shape = w.addShape(BoxShape{{}, {0.1, 0.2, 0.3}});
    d.mass.inertia = {0.1, 0.2, 0.3};
    d.pose.p = {0, 0, 2}, d.omega = {3, 2, 1};
    if (!asked) d.releaseDistance = std::numeric_limits<double>::infinity();
    const BodyId box = w.addBody(d);
    w.hook(box, g, 0);
    int releases = 0;
    play(w, 3, 60, [&](double) {
      for (const ContactEvent& e : w.events())
        if (e.kind == ContactEvent::Kind::Release)
          ++releases;
        else
          impacts[asked].push_back(e.time);
    });
    EXPECT_EQ(releases > 0, asked);
    end[asked] = w.state(box);
  }
  EXPECT_GT(impacts[1].size(), 1u);
  EXPECT_EQ(impacts[0], impacts[1]);
  EXPECT_EQ(end[0].p, end[1].p);
  EXPECT_EQ(end[0].q.coeffs(), end[1].q.coeffs());
}

TEST(World, WhatStartsUpwardsFromTheGroundTellsItsLanding) {
  for (const bool round : {true, false}) {
    World w;
    const FieldId g = addGravity(w);
    w.addCollider({w.addShape(BoxShape{{{0, 0, -1}, Quat::Identity()}, {9, 9, 1}}), {}, {}});
    BodyDef d;
    BallShape ball;
    ball.radius = 0.1;
    d.shape = round ? w.addShape(ball) : w.addShape(BoxShape{{}, {0.1, 0.1, 0.1}});
    d.pose.p = {0, 0, 0.1}, d.v = {1, 0, 5};
    w.hook(w.addBody(d), g, 0);
    int impacts = 0;
    play(w, 1.1, 60, [&](double) {
      for (const ContactEvent& e : w.events()) impacts += e.kind == ContactEvent::Kind::Impact;
    });
    EXPECT_EQ(impacts, 1) << (round ? "ball" : "box");
  }
}

TEST(World, WhatOnlyOneSideStatesHoldsForThePair) {
  const PairSurface a = combine({0.8, {}, {}}, {});
  EXPECT_EQ(a.friction, 0.8);
  EXPECT_EQ(a.restitution, 0.5);
  const PairSurface b = combine({0.9, 0.2, 0.03}, {0.4, 0.6, 0.01});
  EXPECT_NEAR(b.friction, 0.6, 1e-15);
  EXPECT_EQ(b.restitution, 0.6);
  EXPECT_EQ(b.rolling, 0.03);
}

TEST(World, IgnoredPairsPassThroughEachOther) {
  World w;
  const BodyId a = addBall(w, 0, {.p = {-1, 0, 0}, .v = {2, 0, 0}}), b = addBall(w, 0, {});
  w.ignorePair({true, a}, {true, b}, true);
  play(w, 1);
  EXPECT_NEAR(w.state(a).p.x(), 1, 1e-12);
}

TEST(World, SaysHowAFlightIsKnown) {
  const auto classUnder = [](const FieldLaw& law) {
    World w;
    const BodyId ball = addBall(w, addGravity(w), {.v = {1, 0, 5}});
    w.hook(ball, w.addField({law, {}, {}}, true), 0);
    play(w, 0.5);
    return w.state(ball).flight;
  };
  EXPECT_EQ(classUnder(LinearField{Vec3::UnitX()}), FlightClass::Exact);
  EXPECT_EQ(classUnder(MediumField{1.2, 0.5}), FlightClass::Series);
  EXPECT_EQ(classUnder(VortexField{1}), FlightClass::Steps);
}

}  // namespace
}  // namespace stadion
