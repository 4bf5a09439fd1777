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

}  // namespace
}  // namespace stadion
