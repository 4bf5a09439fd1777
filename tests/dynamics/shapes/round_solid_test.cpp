/// Capsules and cylinders on a floor: their contact point follows them as they roll, rock and spin.

#include "engine/maths/functions.h"
#include "tests/dynamics/world/watch.h"

#include <gtest/gtest.h>

namespace stadion {
namespace {

using namespace scenes;

constexpr double kRadius = 0.1, kHalf = 0.2;

BodyId addRod(World& w, FieldId gravity, bool capsule, const Pose& pose, const Vec3& v, const Vec3& omega,
              const Surface& surface) {
  BodyDef d;
  d.shape = capsule ? w.addShape(CapsuleShape{Pose{}, kRadius, kHalf})
                    : w.addShape(CylinderShape{Pose{}, kRadius, kHalf});
  const double m = 1, across = m * (3 * kRadius * kRadius + 4 * kHalf * kHalf) / 12;
  d.mass.mass = m, d.mass.inertia = {across, across, 0.5 * m * kRadius * kRadius};
  d.pose = pose, d.v = v, d.omega = omega, d.surface = surface;
  const BodyId b = w.addBody(d);
  w.hook(b, gravity, 0);
  return b;
}

const Quat kLying = Quat::FromTwoVectors(Vec3::UnitZ(), Vec3::UnitY());

TEST(RoundSolid, ARodRollsAsFarAsItsRollingResistanceAllowsAndSleeps) {
  for (const bool capsule : {false, true}) {
    World w;
    const FieldId g = addGravity(w);
    addFloor(w, 0.5, 0);
    const double c = 0.03, k = 0.5;
    const BodyId b =
        addRod(w, g, capsule, {{0, 0, kRadius}, kLying}, {1, 0, 0}, {0, 1 / kRadius, 0}, {0.5, 0.0, c});
    play(w, 8);
    const double way = 1 / (2 * c * kG / (1 + k));
    std::printf("  %s: %.6f m, should be %.6f\n", capsule ? "capsule" : "cylinder", w.state(b).p.x(), way);
    EXPECT_NEAR(w.state(b).p.x(), way, 1e-3 * way);
    EXPECT_TRUE(w.state(b).asleep());
  }
}

TEST(RoundSolid, ARodOnItsRimOrEndStaysOnTheFloor) {
  for (const bool capsule : {false, true})
    for (const double lean : {0.2, 0.5, 1.0, 1.4}) {
      World w;
      const FieldId g = addGravity(w);
      const ColliderId floor = addFloor(w, 0.5, 0);
      const Quat q = Quat(Eigen::AngleAxisd(lean, Vec3::UnitX()));
      const double low =
          capsule ? kRadius + kHalf * std::cos(lean) : kHalf * std::cos(lean) + kRadius * std::sin(lean);
      const BodyId b =
          addRod(w, g, capsule, {{0, 0, low + 1e-5}, q}, Vec3::Zero(), {0, 0, 4}, {0.5, 0.0, 0.02});
      Watch watch(w, {b});
      double deepest = 0;
      play(w, 10, 60, [&](double) {
        watch.look();
        deepest = std::min(deepest, w.separation({true, b}, {false, floor}));
      });
      std::printf("  %s leaning %.1f: %.1e m deep, rise %.1e, %s\n", capsule ? "capsule" : "cylinder", lean,
                  deepest, watch.greatestRise / watch.first, w.state(b).asleep() ? "asleep" : "awake");
      EXPECT_GE(deepest, -5e-4);
      EXPECT_LE(watch.greatestRise, 1e-4 * watch.first);
      EXPECT_TRUE(w.state(b).asleep());
    }
}

TEST(RoundSolid, ACoinThatRollsFastUprightKeepsItsWay) {
  World w;
  const FieldId g = addGravity(w);
  const ColliderId floor = addFloor(w, 1.0, 0);
  BodyDef d;
  const double r = 0.1, half = 0.001, m = 1;
  d.shape = w.addShape(CylinderShape{Pose{}, r, half});
  d.mass.mass = m, d.mass.inertia = {m * r * r / 4, m * r * r / 4, m * r * r / 2};
  // Rolling straight and upright: stable above omega^2 > g / (3 r).
  d.pose = {{0, 0, r}, kLying}, d.v = {2, 0, 0}, d.omega = {0, 2 / r, 0};
  d.surface = {1.0, 0.0, 0.0};
  const BodyId b = w.addBody(d);
  w.hook(b, g, 0);
  Watch watch(w, {b});
  double deepest = 0;
  play(w, 5, 60, [&](double) {
    watch.look();
    deepest = std::min(deepest, w.separation({true, b}, {false, floor}));
  });
  std::printf("  coin: %.6f m, side %.1e, deep %.1e, rise %.1e\n", w.state(b).p.x(), w.state(b).p.y(),
              deepest, watch.greatestGain / watch.first);
  EXPECT_GE(deepest, -1e-9);
  EXPECT_LE(watch.greatestGain, 1e-9 * watch.first);
  EXPECT_NEAR(w.state(b).p.x(), 10, 1e-6);
  EXPECT_NEAR(w.state(b).p.y(), 0, 1e-6);
}

}  // namespace
}  // namespace stadion
