/// Solids that spin at 300 rad/s meet planes and meshes.

#include "engine/maths/functions.h"
#include "tests/dynamics/world/watch.h"

#include <gtest/gtest.h>

namespace stadion {
namespace {

using namespace scenes;

enum class SpinGround { Plane, Box, Grid };
constexpr std::array kGrounds{SpinGround::Plane, SpinGround::Box, SpinGround::Grid};

ColliderId addGround(World& w, SpinGround kind, double friction, double restitution) {
  const Surface surface{friction, restitution, 0.0};
  switch (kind) {
  case SpinGround::Plane: return w.addCollider({w.addShape(PlaneShape{}), {}, surface});
  case SpinGround::Box:
    return w.addCollider({w.addShape(BoxShape{{{0, 0, -1}, Quat::Identity()}, {400, 400, 1}}), {}, surface});
  case SpinGround::Grid:
    return w.addCollider(
        {w.addShape(MeshShape(TriangleTree(gridMesh(-400, 400, -400, 400, 160, 160)))), {}, surface});
  }
  return 0;
}

/// One drop of one solid: what it did.
struct Drop {
  World w;
  BodyId body = 0;
  ColliderId ground = 0;
  double deepest = 0;

  Drop(Solid kind, SpinGround on, Chance& chance, double friction, double restitution) {
    const FieldId g = addGravity(w);
    ground = addGround(w, on, friction, restitution);
    BodyDef d = solidBody(w, kind, 0.2, 2);
    d.pose = {Vec3(chance.signedUnit(), chance.signedUnit(), 0.6), chance.turn()};
    d.v = 2 * chance.vector(), d.omega = 300 * chance.direction();
    d.surface = {friction, restitution, 0.0};
    body = addSolid(w, g, d);
  }
  void look() { deepest = std::min(deepest, w.separation({true, body}, {false, ground})); }
};

TEST(FastSpin, EverySolidBouncesOffEveryGroundWithoutSinkingInOrGainingEnergy) {
  Chance chance(51);
  for (int i = 0; i < 54; ++i) {
    const Solid kind = kSolids[static_cast<std::size_t>(i) % 6];
    const SpinGround on = kGrounds[static_cast<std::size_t>(i / 6) % 3];
    const double e = 0.5 * (i / 18 % 3), mu = i % 4 == 0 ? 0 : 0.6;
    Drop drop(kind, on, chance, mu, e);
    Watch watch(drop.w, {drop.body});
    play(drop.w, 1.2, 60, [&](double) { watch.look(), drop.look(); });
    const std::string what = std::string(nameOf(kind)) + ", ground " + std::to_string(i / 6 % 3) + ", e " +
                             std::to_string(e) + ", friction " + std::to_string(mu);
    EXPECT_TRUE(watch.finite) << what;
    EXPECT_EQ(watch.limited, 0u) << what;
    EXPECT_LE(watch.greatestRise, 1e-4 * watch.first) << what;
    EXPECT_GE(drop.deepest, -2e-3) << what;
  }
}

TEST(FastSpin, ABallThatLandsGripsWhereTheClosedFormSays) {
  // Spin about a level axis turns into speed: of v = 0 and omega, a share k / (1 + k) of omega r is left.
  for (const SpinGround on : kGrounds) {
    World w;
    const FieldId g = addGravity(w);
    addGround(w, on, 0.5, 0);
    const BodyId b =
        addBall(w, g, {.radius = 0.1, .p = {-3.1, 0.2, 0.1}, .omega = {0, 300, 0}, .friction = 0.5});
    const double last = 2.0 / 7 * 300 * 0.1, grip = last / (0.5 * kG);
    Watch watch(w, {b});
    play(w, 3, 60, [&](double t) {
      watch.look();
      const double x = t < grip ? 0.25 * kG * t * t : 0.5 * last * grip + last * (t - grip);
      EXPECT_NEAR(w.state(b).p.x() + 3.1, x, on == SpinGround::Grid ? 1e-4 : 1e-9) << t;
    });
    EXPECT_LE(watch.greatestRise, 1e-9 * watch.first);
    EXPECT_NEAR(w.state(b).v.x(), last, 1e-6);
    EXPECT_NEAR(w.state(b).omega.y(), last / 0.1, 1e-5);
  }
}

TEST(FastSpin, ATopOnTheFloorOnlyLosesEnergyAndStaysOnIt) {
  // A disc that wobbles on its rim sinks in by millimetres: the point that carries it travels along the rim
  // faster than steps follow. It is pushed out again, and never gets through.
  Chance chance(52);
  for (int i = 0; i < 12; ++i) {
    Drop drop(i % 2 ? Solid::Cylinder : Solid::Box, kGrounds[static_cast<std::size_t>(i / 2) % 3], chance,
              0.6, 0.2);
    Watch watch(drop.w, {drop.body});
    play(drop.w, 6, 60, [&](double) { watch.look(), drop.look(); });
    EXPECT_TRUE(watch.finite) << i;
    EXPECT_EQ(watch.limited, 0u) << i;
    EXPECT_GE(drop.deepest, i % 2 ? -6e-3 : -1e-3) << i;
    EXPECT_LE(watch.greatestRise, 1e-4 * watch.first) << i;
    EXPECT_LE(watch.last, 0.7 * watch.first) << i;
  }
}

TEST(FastSpin, TwoSpinnersThatMeetInSpaceKeepTheirAngularMomentum) {
  Chance chance(53);
  for (int i = 0; i < 36; ++i) {
    World w;
    std::vector<BodyId> both;
    const Solid kinds[2] = {kSolids[static_cast<std::size_t>(i) % 6],
                            kSolids[static_cast<std::size_t>(i / 6) % 6]};
    for (int k = 0; k < 2; ++k) {
      BodyDef d = solidBody(w, kinds[k], 0.2, 1 + k);
      d.pose = {Vec3(k ? 0.6 : -0.6, 0, 0) + 0.05 * chance.vector(), chance.turn()};
      d.v = Vec3(k ? -2 : 2, 0, 0), d.omega = 300 * chance.direction();
      d.surface = {0.3, 1.0, 0.0};
      both.push_back(w.addBody(d));
    }
    const Balance before = balanceOf(w, both, Vec3::Zero());
    Watch watch(w, both, Vec3::Zero());
    play(w, 1, watch);
    const Balance after = balanceOf(w, both, Vec3::Zero());
    const std::string what = std::string(nameOf(kinds[0])) + " and " + nameOf(kinds[1]);
    EXPECT_TRUE(watch.finite) << what;
    EXPECT_EQ(watch.limited, 0u) << what;
    EXPECT_LE((after.momentum - before.momentum).norm(), 1e-11) << what;
    EXPECT_LE((after.angular - before.angular).norm(), 1e-10) << what;
    EXPECT_LE(watch.greatestGain, 1e-10 * watch.first) << what;
    EXPECT_GE(w.separation({true, both[0]}, {true, both[1]}), -1e-6) << what;
  }
}

}  // namespace
}  // namespace stadion
