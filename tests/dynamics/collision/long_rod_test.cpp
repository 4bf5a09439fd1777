/// Long thin solids that fall nearly flat: one end strikes and turns the body, and then the other end comes
/// down, on whatever they fall and however they turn. About their length they could turn thousands of times
/// as fast as across it, if they had the angular momentum for it.

#include "tests/dynamics/world/scenes.h"

#include <gtest/gtest.h>

#include <random>

namespace stadion {
namespace {

using namespace scenes;

struct Rod {
  double length, thick;  ///< halves [m]
  double spin;           ///< about its length [rad/s]
};

enum class FloorKind { HalfSpace, Sheet, Box, Mesh };

void addFloorOf(World& w, FloorKind kind) {
  const Surface surface{0.2, 0.6, 0};
  PlaneShape sheet;
  sheet.half = {50, 50};
  switch (kind) {
  case FloorKind::HalfSpace: w.addCollider({w.addShape(PlaneShape{}), {}, surface}); break;
  case FloorKind::Sheet: w.addCollider({w.addShape(sheet), {}, surface}); break;
  case FloorKind::Box:
    w.addCollider({w.addShape(BoxShape{{{0, 0, -1}, Quat::Identity()}, {50, 50, 1}}), {}, surface});
    break;
  case FloorKind::Mesh:
    w.addCollider({w.addShape(MeshShape(TriangleTree(gridMesh(-20, 20, -20, 20, 4, 4)))), {}, surface});
    break;
  }
}

/// How deep its lowest corner gets below the floor in two seconds [m].
double deepest(FloorKind floor, const Rod& rod, const Quat& q, const Vec3& v) {
  World w;
  const FieldId g = addGravity(w);
  addFloorOf(w, floor);
  const Vec3 half(rod.length, rod.thick, 1.2 * rod.thick);
  const BodyId b = addBox(w, g,
                          {.half = half,
                           .pose = {{0, 0, 1.5}, q},
                           .v = v,
                           .omega = rod.spin * (q * Vec3::UnitX()),
                           .friction = 0.6});
  double deep = 0;
  play(w, 2, 60, [&](double) {
    for (int i = 0; i < 8; ++i) {
      const Vec3 corner = half.cwiseProduct(Vec3(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1));
      deep = std::max(deep, -(w.state(b).pose * corner).z());
    }
  });
  return deep;
}

TEST(LongRod, BothEndsMeetEveryFloor) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> any(-1, 1);
  for (const FloorKind floor : {FloorKind::HalfSpace, FloorKind::Sheet, FloorKind::Box, FloorKind::Mesh})
    for (const Rod& rod : {Rod{0.3, 0.015, 0}, Rod{1.32, 0.015, 0}, Rod{1.32, 0.015, 50}, Rod{1.3, 0.003, 0},
                           Rod{1.32, 0.05, 5}, Rod{0.6, 0.2, 20}})
      for (int trial = 0; trial < 5; ++trial) {
        const double tilt = 0.1 * any(random), roll = any(random);
        const Quat q =
            Quat(Eigen::AngleAxisd(tilt, Vec3::UnitY())) * Quat(Eigen::AngleAxisd(roll, Vec3::UnitX()));
        const Vec3 v(0, 5 * any(random), 0);
        EXPECT_LT(deepest(floor, rod, q, v), 1e-3)
            << "floor " << static_cast<int>(floor) << ", length " << 2 * rod.length << ", thick "
            << 2 * rod.thick << ", spin " << rod.spin << ", tilt " << tilt << ", roll " << roll;
      }
}

/// A shaft with many sides, thicker in the middle, with a disc-like collar.
Mesh shaftMesh(int sectors) {
  const std::pair<double, double> profile[] = {
      {-1.3, 0.004}, {-0.1, 0.012}, {0, 0.015}, {0.15, 0.0145}, {1.3, 0.006}};
  std::vector<Vec3> p;
  std::vector<std::array<std::uint32_t, 3>> t;
  for (const auto& [x, r] : profile)
    for (int i = 0; i < sectors; ++i)
      p.emplace_back(x, r * std::cos(2 * M_PI * i / sectors), r * std::sin(2 * M_PI * i / sectors));
  const auto at = [&](int ring, int i) { return static_cast<std::uint32_t>(ring * sectors + i % sectors); };
  for (int ring = 0; ring < 4; ++ring)
    for (int i = 0; i < sectors; ++i) {
      t.push_back({at(ring, i), at(ring, i + 1), at(ring + 1, i + 1)});
      t.push_back({at(ring, i), at(ring + 1, i + 1), at(ring + 1, i)});
    }
  for (int i = 1; i + 1 < sectors; ++i) {
    t.push_back({at(0, 0), at(0, i + 1), at(0, i)});
    t.push_back({at(4, 0), at(4, i), at(4, i + 1)});
  }
  return meshOf(p, t);
}

// Many points in a row press a shaft that hardly resists being spun: they contradict each other, and an
// answer of theirs once ran to infinity.
TEST(LongRod, AShaftOfAMeshThatLiesInAirStaysFinite) {
  const Mesh mesh = shaftMesh(16);
  std::mt19937 random(9);
  std::uniform_real_distribution<double> any(-1, 1);
  for (int trial = 0; trial < 24; ++trial) {
    World w;
    const FieldId g = addGravity(w), air = w.addField({MediumField{}, {}, {}, 0});
    w.addCollider({w.addShape(PlaneShape{}), {}, {0.2, 0.6, 0}});
    BodyDef d;
    d.shape = w.addShape(MeshShape(TriangleTree(mesh)));
    d.pose = {{0, 0, 0.2 + 0.8 * std::fabs(any(random))},
              Quat(Eigen::AngleAxisd(0.05 * any(random), Vec3::UnitY())) *
                  Quat(Eigen::AngleAxisd(3 * any(random), Vec3::UnitX()))};
    d.v = {20 * any(random), any(random), 0};
    d.mass.mass = 0.806, d.mass.inertia = {1.5e-4, 0.42, 0.42};
    d.surface = {0.6, 0.2, 0};
    d.dragArea = 0.01;
    const BodyId b = w.addBody(d);
    w.hook(b, g, 0), w.hook(b, air, 0);
    play(w, 5);
    EXPECT_NE(w.mode(b), BodyMode::Quarantined) << "trial " << trial;
    EXPECT_GT(w.state(b).p.z(), 0) << "trial " << trial;
  }
}

}  // namespace
}  // namespace stadion
