/// Solids that land flat on, or nearly: all their points rebound at once, and nothing depends on rounding.

#include "engine/maths/functions.h"
#include "tests/dynamics/world/scenes.h"

#include <gtest/gtest.h>

namespace stadion {
namespace {

using namespace scenes;

constexpr double kDrop = 0.5, kRestitution = 0.5;

BodyDef boxDef(World& w, bool mesh, const Vec3& half) {
  BodyDef d;
  d.shape = mesh ? w.addShape(MeshShape(TriangleTree(boxMesh(half)))) : w.addShape(BoxShape{{}, half});
  d.mass = massOfBox({}, half, 1).withMass(1);
  d.surface = {0.5, kRestitution, 0.0};
  return d;
}

BodyDef rodDef(World& w, bool capsule) {
  BodyDef d;
  d.shape =
      capsule ? w.addShape(CapsuleShape{Pose{}, 0.1, 0.2}) : w.addShape(CylinderShape{Pose{}, 0.1, 0.3});
  d.mass.mass = 1, d.mass.inertia = {0.03, 0.03, 0.005};
  d.surface = {0.5, kRestitution, 0.0};
  return d;
}

struct Landing {
  double rebound = 0, spin = 0;  ///< just after the first impact [m/s], [rad/s]
  double lowest = 0, tilt = 0;   ///< [m], [rad], over four seconds
};

Landing land(World& w, BodyDef d, double height, double tilt) {
  const FieldId g = addGravity(w);
  d.pose = {{0.03, 0.07, height + kDrop}, Quat(Eigen::AngleAxisd(tilt, Vec3(0.6, 0.8, 0)))};
  const BodyId b = w.addBody(d);
  w.hook(b, g, 0);
  Landing l;
  play(w, 4, 240, [&](double t) {
    const BodyState s = w.state(b);
    if (std::fabs(t - 0.325) < 1e-3)
      l.rebound = s.v.z() + kG * (t - std::sqrt(2 * kDrop / kG)), l.spin = s.omega.norm();
    l.lowest = std::min(l.lowest, s.p.z());
    l.tilt = std::max(l.tilt, std::acos(std::min(1.0, std::fabs((w.pose(b).q * Vec3::UnitZ()).z()))));
  });
  return l;
}

void addGround(World& w, bool mesh) {
  const ShapeId s =
      mesh ? w.addShape(MeshShape(TriangleTree(gridMesh(-5, 5, -5, 5, 31, 29)))) : w.addShape(PlaneShape{});
  w.addCollider({s, {}, {0.5, kRestitution, 0.0}});
}

const double kImpact = std::sqrt(2 * kG * kDrop);

TEST(FlatLanding, EverythingReboundsStraightUp) {
  for (const bool ground : {false, true})
    for (int kind = 0; kind < 5; ++kind) {
      World w;
      addGround(w, ground);
      const Vec3 half(0.3, 0.2, kind == 2 ? 0.02 : 0.3);
      const Landing l =
          kind < 3 ? land(w, boxDef(w, kind > 0, half), half.z(), 0) : land(w, rodDef(w, kind == 3), 0.3, 0);
      EXPECT_NEAR(l.rebound, kRestitution * kImpact, 2e-6) << ground << kind;
      EXPECT_LE(l.spin, 1e-9) << ground << kind;
      EXPECT_LE(l.tilt, 1e-6) << ground << kind;
      EXPECT_GE(l.lowest, 0) << ground << kind;  // the second bounce is on the ground as well
    }
}

TEST(FlatLanding, ATiltThatIsRoundingChangesNothing) {
  for (const bool mesh : {false, true}) {
    for (const double tilt : {0.0, 1e-12, 1e-9, 1e-7, 1e-6}) {
      World w;
      addGround(w, false);
      const Landing l = land(w, boxDef(w, mesh, {0.3, 0.3, 0.3}), 0.3, tilt);
      EXPECT_NEAR(l.rebound, kRestitution * kImpact, 1e-3) << tilt;
      EXPECT_LE(l.tilt, 20 * tilt + 1e-7) << tilt;
    }
  }
}

TEST(FlatLanding, OnAnEdgeItTurnsOverTheEdge) {
  // Two corners touch together: the impulse acts between them.
  World w;
  addGround(w, false);
  BodyDef d = boxDef(w, false, {0.3, 0.3, 0.3});
  const FieldId g = addGravity(w);
  const double lean = 0.3, low = 0.3 * (std::cos(lean) + std::sin(lean));
  d.pose = {{0, 0, low + kDrop}, Quat(Eigen::AngleAxisd(lean, Vec3::UnitX()))};
  d.surface = {0.0, kRestitution, 0.0};
  const BodyId b = w.addBody(d);
  w.hook(b, g, 0);
  double about = 0, across = 0;
  play(w, 0.33, 240, [&](double) {
    const BodyState s = w.state(b);
    about = s.omega.x(), across = std::max(std::fabs(s.omega.y()), std::fabs(s.omega.z()));
  });
  // J (1/m + r^2 / I) = (1 + e) v, and J r / I is the spin.
  const double r = 0.3 * (std::cos(lean) - std::sin(lean)), I = d.mass.inertia.x();
  EXPECT_NEAR(std::fabs(about), (1 + kRestitution) * kImpact / (1 + r * r / I) * r / I, 1e-6);
  EXPECT_LE(across, 1e-9);
}

}  // namespace
}  // namespace stadion
