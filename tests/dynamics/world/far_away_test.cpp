/// A hundred kilometres from the origin everything goes as it does at the origin.

#include "engine/maths/functions.h"
#include "tests/dynamics/world/watch.h"

#include <gtest/gtest.h>

namespace stadion {
namespace {

using namespace scenes;

const std::array kPlaces{Vec3(1e5, 0, 0), Vec3(-1e5, 1e5, 0), Vec3(7e4, -4e4, 6e4)};

/// Plays the same scene at the origin and elsewhere. `build(world, origin)` returns the bodies; the greatest
/// distance between where they are and should be, over all frames.
template <class Build>
double apart(double seconds, Build build) {
  double worst = 0;
  for (const Vec3& place : kPlaces) {
    World here, there;
    const std::vector<BodyId> a = build(here, Vec3(Vec3::Zero())), b = build(there, place);
    const auto frames = static_cast<std::uint64_t>(seconds * 60 + 0.5);
    for (std::uint64_t n = 1; n <= frames; ++n) {
      const TimeSignature s = signatureAt(n, 60);
      here.advance(s.time - s.step, s.time), there.advance(s.time - s.step, s.time);
      for (std::size_t i = 0; i < a.size(); ++i) {
        const BodyState x = here.state(a[i]), y = there.state(b[i]);
        worst = std::max(worst, (y.p - place - x.p).norm());
        worst =
            std::max(worst, det::logRotation(x.q.conjugate() * y.q).norm() * 0.1);  // of a point 10 cm off
      }
      EXPECT_EQ(there.counters().limited, 0u);
    }
  }
  return worst;
}

TEST(FarAway, FlightUnderAnyFieldIsTheSame) {
  Chance chance(61);
  for (int i = 0; i < 24; ++i) {
    const Vec3 v = 10 * chance.vector(), omega = (i % 3 ? 10 : 300) * chance.vector();
    const double damping = i % 4 == 1 ? 0.3 : 0;
    const auto build = [&](World& w, const Vec3& at) {
      const FieldId g = addGravity(w);
      ForceField f;
      f.start.p = f.end.p = at;
      if (i % 4 == 2) f.law = MediumField{1.2, 0.1, {2, 1, 0}};
      if (i % 4 == 3) f.law = VortexField{3, 0.5, 0.4};
      if (i % 8 == 7) f.law = PointField{-30, 0.3};
      const FieldId more = w.addField(f, i % 4 >= 2);
      BodyDef d = solidBody(w, i % 2 ? Solid::Box : Solid::Cylinder, 0.2, 1);
      d.pose.p = at + Vec3(2, 1, 0), d.v = v, d.omega = omega, d.damping = damping, d.dragArea = 0.05;
      const BodyId b = addSolid(w, g, d);
      w.hook(b, more, 0);
      return std::vector{b};
    };
    EXPECT_LE(apart(2, build), 1e-8) << i;
  }
}

TEST(FarAway, ABallBouncesOnPlanesBoxesAndMeshesTheSame) {
  for (int i = 0; i < 12; ++i) {
    const double e = std::array{1.0, 0.8, 0.5}[static_cast<std::size_t>(i) % 3];
    const auto build = [&](World& w, const Vec3& at) {
      const FieldId g = addGravity(w);
      Shape ground = PlaneShape{};
      if (i / 3 == 1) ground = BoxShape{{{0, 0, -1}, Quat::Identity()}, {50, 50, 1}};
      if (i / 3 == 2) ground = MeshShape(TriangleTree(gridMesh(-10, 10, -10, 10, 20, 20)));
      if (i / 3 == 3)
        ground = *convexHull({{-9, -9, -1},
                              {9, -9, -1},
                              {-9, 9, -1},
                              {9, 9, -1},
                              {-9, -9, 0},
                              {9, -9, 0},
                              {-9, 9, 0},
                              {9, 9, 0}});
      w.addCollider({w.addShape(std::move(ground)), {at, Quat::Identity()}, {0.0, e, 0.0}});
      const BodyId b = addBall(w, g, {.p = at + Vec3(0.3, 0.1, 1.1), .v = {1, 0.3, 0}, .restitution = e});
      return std::vector{b};
    };
    EXPECT_LE(apart(4, build), 1e-8) << i;
  }
}

TEST(FarAway, BallsThatRollAndBoxesThatSlideStopAtTheSamePlace) {
  const auto build = [](World& w, const Vec3& at) {
    const FieldId g = addGravity(w);
    w.addCollider({w.addShape(PlaneShape{}), {at, Quat::Identity()}, {0.5, 0.0, 0.0}});
    const BodyId ball =
        addBall(w, g, {.p = at + Vec3(0, 3, 0.1), .v = {5, 0, 0}, .friction = 0.5, .rolling = 0.05});
    const BodyId box = addBox(w, g,
                              {.half = {0.15, 0.15, 0.05},
                               .pose = {at + Vec3(0, 0, 0.05), det::fromEuler(0, 0, 0.4)},
                               .v = {2, 1, 0},
                               .friction = 0.5});
    return std::vector{ball, box};
  };
  EXPECT_LE(apart(6, build), 1e-8);
}

TEST(FarAway, BallsCollideTheSame) {
  // Few enough bounces that rounding has not grown: each makes a difference of paths some tens of times
  // larger.
  const auto build = [](World& w, const Vec3& at) {
    return std::vector{
        addBall(w, 0, {.p = at + Vec3(-1, 0.02, 0), .v = {3, 0, 0}, .restitution = 0.9, .friction = 0.3}),
        addBall(w, 0, {.mass = 3, .p = at, .restitution = 0.9, .friction = 0.3}),
        addBall(w, 0, {.p = at + Vec3(0.7, 0, 0.05), .restitution = 0.9, .friction = 0.3})};
  };
  EXPECT_LE(apart(2, build), 1e-8);
}

TEST(FarAway, ASolidThrownAtAThinWallDoesNotGetThrough) {
  Chance chance(62);
  for (int i = 0; i < 24; ++i) {
    const Solid kind = kSolids[static_cast<std::size_t>(i) % 6];
    const Vec3 at = kPlaces[static_cast<std::size_t>(i) % 3];
    World w;
    w.addCollider({w.addShape(BoxShape{{}, {0.0005, 10, 10}}), {at, Quat::Identity()}, {0.3, 0.5, 0.0}});
    BodyDef d = solidBody(w, kind, 0.05, 1);
    d.pose = {at + Vec3(-1, 0, 0) + 0.1 * chance.vector(), chance.turn()};
    d.v = {chance.scale(5, 1000), 0, 0}, d.omega = 40 * chance.vector(), d.surface = {0.3, 0.5, 0.0};
    const BodyId b = w.addBody(d);
    Watch watch(w, {b}, Vec3::Zero());
    play(w, 0.5, watch);
    EXPECT_LT(w.state(b).p.x() - at.x(), 0) << nameOf(kind) << " at " << d.v.x();
    EXPECT_LT(w.state(b).v.x(), 0) << nameOf(kind) << " at " << d.v.x();
    EXPECT_TRUE(watch.finite);
    EXPECT_LE(watch.greatestGain, 1e-9 * watch.first);
  }
}

TEST(FarAway, SolidsThrownDownComeToRestOnTheGround) {
  Chance chance(63);
  for (int i = 0; i < 18; ++i) {
    const Solid kind = kSolids[static_cast<std::size_t>(i) % 6];
    const Vec3 at = kPlaces[static_cast<std::size_t>(i / 6)];
    World w;
    const FieldId g = addGravity(w);
    const ColliderId floor =
        w.addCollider({i % 2 ? w.addShape(MeshShape(TriangleTree(gridMesh(-10, 10, -10, 10, 10, 10))))
                             : w.addShape(PlaneShape{}),
                       {at, Quat::Identity()},
                       {0.5, 0.3, 0.02}});
    BodyDef d = solidBody(w, kind, 0.2, 1);
    d.pose = {at + Vec3(0, 0, 1), chance.turn()}, d.v = chance.vector(), d.omega = 5 * chance.vector();
    d.surface = {0.5, 0.3, 0.02};
    const BodyId b = addSolid(w, g, d);
    Watch watch(w, {b}, Vec3(0, 0, -kG), at);
    play(w, 12, watch, 30);
    EXPECT_TRUE(watch.finite) << nameOf(kind);
    EXPECT_EQ(watch.limited, 0u);
    EXPECT_LE(watch.greatestRise, 3e-3 * watch.first) << nameOf(kind);
    EXPECT_NEAR(w.separation({true, b}, {false, floor}), 0, 2e-4) << nameOf(kind);
    const bool rolls = kind == Solid::Capsule || kind == Solid::Cylinder;  // and nothing stops it
    EXPECT_TRUE(rolls || w.state(b).asleep()) << nameOf(kind) << ' ' << w.state(b).v.norm();
  }
}

}  // namespace
}  // namespace stadion
