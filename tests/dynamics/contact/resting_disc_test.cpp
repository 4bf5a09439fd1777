/// Discs that are braked as they roll: they fall over freely, and lie still where they have come to rest.

#include "engine/maths/functions.h"
#include "tests/dynamics/world/sampled.h"
#include "tests/dynamics/world/watch.h"

#include <gtest/gtest.h>

namespace stadion {
namespace {

using namespace scenes;

/// A disc like those that are thrown, of so much rolling resistance.
BodyDef disc(World& w, double rolling) {
  BodyDef d;
  d.shape = w.addShape(CylinderShape{{}, 0.11, 0.0165});
  d.mass = massOfRound(0.11, 0.0165, 2);
  d.surface = {0.5, 0.2, rolling};
  return d;
}

/// Banks around a hollow, with furrows and ridges.
Mesh banks() {
  Mesh m = gridMesh(-10, 10, -10, 10, 40, 40);
  for (auto& p : m.positions) {
    const double x = double(p[0]), y = double(p[1]);
    p[2] = static_cast<float>(0.1 * std::sin(0.7 * x) * std::cos(0.9 * y) + 0.04 * (x * x + y * y));
  }
  return m;
}

TEST(RestingDisc, ThrownOntoBanksItComesToRest) {
  int awake = 0;  // one of these trembles on an edge between two faces at 0.1 mm/s
  for (const double rolling : {0.02, 0.1, 0.35, 0.5}) {
    Chance chance(7);
    for (int n = 0; n < 6; ++n) {
      if (!isPlayed(n)) continue;
      World w;
      w.addCollider({w.addShape(MeshShape(TriangleTree(banks()))), {}, {0.5, 0.2, 0.05}});
      BodyDef d = disc(w, rolling);
      d.pose = {{0.3, 2, 0.7}, chance.turn()};
      d.v = {chance.signedUnit(), 2 + 2 * chance.signedUnit(), 0}, d.omega = 20 * chance.vector();
      const BodyId b = addSolid(w, addGravity(w), d);
      Watch watch(w, {b});
      for (int second = 0; second < 20 && !watch.asleep(); ++second)
        for (int i = 1; i <= 60; ++i) {
          const TimeSignature s = signatureAt(static_cast<std::uint64_t>(60 * second + i), 60);
          w.advance(s.time - s.step, s.time), watch.look();
        }
      EXPECT_TRUE(watch.finite);
      awake += !watch.asleep();
      EXPECT_LT(w.state(b).v.norm(), 5e-4) << rolling << " throw " << n;
    }
  }
  EXPECT_LE(awake, 1);
}

/// Seconds until a disc that leans by 0.3 rad, as it is let go on its edge, lies flat.
double fallsOverIn(double rolling) {
  World w;
  addFloor(w, 0.5);
  BodyDef d = disc(w, rolling);
  d.pose.q = det::expRotation(Vec3(M_PI / 2 - 0.3, 0, 0));
  d.pose.p.z() = 0.11 * std::cos(0.3) + 0.0165 * std::sin(0.3) + 1e-6;
  const BodyId b = addSolid(w, addGravity(w), d);
  double flat = 1e9;
  play(w, 3, 240, [&](double t) {
    if (w.state(b).p.z() < 0.02) flat = std::min(flat, t);
  });
  return flat;
}

TEST(RestingDisc, RollingResistanceDoesNotKeepItFromFallingOver) {
  EXPECT_NEAR(fallsOverIn(0.35), fallsOverIn(0), 0.03);
  EXPECT_LT(fallsOverIn(0.35), 1);
}

/// How far the lowest point of a cylinder is below the floor z = 0 [m].
double depthOf(const Pose& X, double radius, double half) {
  const double rise = std::fabs((X.q * Vec3::UnitZ()).z());
  return radius * std::sqrt(std::max(0.0, 1 - rise * rise)) + half * rise - X.p.z();
}

double energyOf(const World& w, BodyId b, double mass) {
  const BodyState s = w.state(b);
  return 0.5 * mass * s.v.squaredNorm() + 0.5 * s.L.dot(s.omega) + mass * kG * s.p.z();
}

// Its point of contact runs round the rim. The forces there do no work, but in a step of finite length they do a
// little, of either sign.
TEST(RollingCoin, NeitherSinksInNorGainsEnergyAndOnSlipperyGroundKeepsIt) {
  constexpr double kRadius = 0.3, kHalf = 0.09, kMass = 2;
  for (const double friction : {0.0, 0.3, 0.8})
    for (const double lean : {0.4, 0.7, 1.1})
      for (const double spin : {3.0, 6.0}) {
        SCOPED_TRACE(testing::Message() << friction << " " << lean << " " << spin);
        World w;
        const FieldId g = addGravity(w);
        addFloor(w, friction, 0);
        BodyDef d;
        d.shape = w.addShape(CylinderShape{{}, kRadius, kHalf});
        d.mass = massOfRound(kRadius, kHalf, kMass);
        d.surface = {friction, 0.0, 0.0};
        d.pose.q = Quat(Eigen::AngleAxisd(lean, Vec3::UnitX()));
        d.pose.p.z() = kRadius * std::sin(lean) + kHalf * std::cos(lean);
        d.omega.z() = spin;
        d.v.x() = 0.5;
        const BodyId b = addSolid(w, g, d);
        double deepest = 0, first = 0, least = 1e9, rise = 0;
        play(w, 8, 60, [&](double) {
          deepest = std::max(deepest, depthOf(w.pose(b), kRadius, kHalf));
          const double energy = energyOf(w, b, kMass);
          if (first == 0) first = energy;
          least = std::min(least, energy);
          rise = std::max(rise, energy - least);
        });
        EXPECT_LT(deepest, 3e-5);
        EXPECT_LT(rise, 1e-3 * least);
        if (friction == 0) {
          EXPECT_GT(least, 0.995 * first);
        }
      }
}

}  // namespace
}  // namespace stadion
