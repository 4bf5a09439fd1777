/// Towers of bodies of very different mass stand, whatever the order, the rate and the shape.

#include "tests/dynamics/world/watch.h"

#include <gtest/gtest.h>

namespace stadion {
namespace {

using namespace scenes;

constexpr double kHalf = 0.25;

BodyId addCrate(World& w, FieldId g, Solid kind, double half, double mass, const Vec3& p) {
  BodyDef d;
  if (kind == Solid::Box) {
    d.shape = w.addShape(BoxShape{{}, Vec3::Constant(half)});
  } else if (kind == Solid::Convex) {
    std::vector<Vec3> corners;
    for (int i = 0; i < 8; ++i)
      corners.emplace_back(half * Vec3(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1));
    d.shape = w.addShape(*convexHull(corners));
  } else {
    d.shape = w.addShape(MeshShape(TriangleTree(boxMesh(Vec3::Constant(half)))));
  }
  d.mass = massOfBox({}, Vec3::Constant(half), 1).withMass(mass);
  d.surface = {0.5, 0.0, 0.0};
  d.pose.p = p;
  return addSolid(w, g, d);
}

/// Crates of these masses from below, 1 cm apart, after so long: how far the worst is from where it belongs.
double leans(Solid kind, const std::vector<double>& masses, double rate, double seconds) {
  World w;
  const FieldId g = addGravity(w);
  addFloor(w, 0.5);
  std::vector<BodyId> tower;
  for (std::size_t i = 0; i < masses.size(); ++i)
    tower.push_back(addCrate(w, g, kind, kHalf, masses[i], {0, 3, 0.26 + 0.51 * static_cast<double>(i)}));
  play(w, seconds, rate);
  double worst = 0;
  for (std::size_t i = 0; i < tower.size(); ++i)
    worst = std::max(worst, (w.state(tower[i]).p - Vec3(0, 3, kHalf + 0.5 * static_cast<double>(i))).norm());
  return worst;
}

std::vector<double> inTurn(std::size_t many, double first, double second) {
  std::vector<double> masses;
  for (std::size_t i = 0; i < many; ++i) masses.push_back(i % 2 == 0 ? first : second);
  return masses;
}

TEST(Tower, TenCratesOfOneAndAHundredKilogramsStand) {
  for (const Solid kind : {Solid::Box, Solid::Convex, Solid::Mesh}) {
    EXPECT_LT(leans(kind, inTurn(10, 1, 100), 60, 4), 1e-3) << nameOf(kind);
    EXPECT_LT(leans(kind, inTurn(10, 100, 1), 60, 4), 1e-3) << nameOf(kind);
  }
  for (const double rate : {24., 144.})
    EXPECT_LT(leans(Solid::Box, inTurn(10, 1, 100), rate, 4), 1e-3) << rate;
}

TEST(Tower, PairsOfOneAndAThousandStand) {
  for (const std::size_t many : {2u, 4u, 6u}) {
    EXPECT_LT(leans(Solid::Box, inTurn(many, 1, 1000), 60, 4), 1e-3) << many;
    EXPECT_LT(leans(Solid::Box, inTurn(many, 1000, 1), 60, 4), 1e-3) << many;
  }
}

TEST(Tower, TwentyEqualCratesStand) {
  EXPECT_LT(leans(Solid::Box, inTurn(20, 5, 5), 60, 6), 1e-3);
}

TEST(Tower, AHeavyCrateStandsOnThreeSmallOnes) {
  for (const double mass : {10., 1000.}) {
    World w;
    const FieldId g = addGravity(w);
    addFloor(w, 0.5);
    std::vector<BodyId> all;
    for (const Vec3& p : {Vec3(-0.15, -0.15, 0.06), Vec3(0.15, -0.15, 0.06), Vec3(0, 0.15, 0.06)})
      all.push_back(addCrate(w, g, Solid::Box, 0.05, 1, p));
    all.push_back(addCrate(w, g, Solid::Box, kHalf, mass, {0, 0, 0.37}));
    play(w, 4);
    EXPECT_LT((w.state(all[3]).p - Vec3(0, 0, 0.35)).norm(), 1e-3) << mass;
    EXPECT_TRUE(w.state(all[3]).asleep()) << mass;
  }
}

}  // namespace
}  // namespace stadion
