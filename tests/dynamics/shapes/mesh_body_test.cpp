#include "engine/maths/functions.h"
#include "tests/dynamics/world/scenes.h"

#include <gtest/gtest.h>

namespace stadion {
namespace {

using namespace scenes;

/// An L of two bars 30 cm thick, standing on the end of one of them at z = 0.
Mesh ellMesh() {
  std::vector<Vec3> p;
  for (const double y : {0.0, -0.3})
    for (const auto& [x, z] :
         {std::pair(0.0, 0.0), {1.0, 0.0}, {1.0, 0.3}, {0.3, 0.3}, {0.3, 1.0}, {0.0, 1.0}})
      p.emplace_back(x, y, z);
  return meshOf(p, {{2, 1, 0},   {3, 2, 0},  {4, 3, 0},  {5, 4, 0},   {6, 7, 8}, {6, 8, 9}, {6, 9, 10},
                    {6, 10, 11}, {0, 1, 7},  {0, 7, 6},  {1, 2, 8},   {1, 8, 7}, {2, 3, 9}, {2, 9, 8},
                    {3, 4, 10},  {3, 10, 9}, {4, 5, 11}, {4, 11, 10}, {5, 0, 6}, {5, 6, 11}});
}

/// A flat ring with a square profile.
Mesh ringMesh(double outer, double inner, double height, int sectors) {
  std::vector<Vec3> p;
  std::vector<std::array<std::uint32_t, 3>> t;
  for (int i = 0; i < sectors; ++i) {
    const double a = 2 * M_PI * i / sectors;
    for (const auto& [r, z] : {std::pair(outer, -1.0), {outer, 1.0}, {inner, 1.0}, {inner, -1.0}})
      p.emplace_back(r * std::cos(a), r * std::sin(a), 0.5 * height * z);
  }
  const auto at = [&](int i, int k) { return static_cast<std::uint32_t>(4 * (i % sectors) + k % 4); };
  for (int i = 0; i < sectors; ++i)
    for (int k = 0; k < 4; ++k) {
      t.push_back({at(i, k), at(i + 1, k), at(i + 1, k + 1)});
      t.push_back({at(i, k), at(i + 1, k + 1), at(i, k + 1)});
    }
  return meshOf(p, t);
}

BodyId addMesh(World& w, FieldId gravity, const Mesh& mesh, const Pose& pose, double friction = 0.5,
               double restitution = 0.3, const Vec3& v = Vec3::Zero()) {
  BodyDef d;
  d.shape = w.addShape(MeshShape(TriangleTree(mesh)));
  d.pose = pose, d.v = v;
  const auto mass = massOfMesh(mesh, 1000);
  d.mass = mass.value().withMass(1);
  d.surface = {friction, restitution, 0.0};
  const BodyId id = w.addBody(d);
  w.hook(id, gravity, 0);
  return id;
}

ColliderId addMeshFloor(World& w, const Mesh& mesh, const Pose& pose = {}) {
  return w.addCollider({w.addShape(MeshShape(TriangleTree(mesh))), pose, {0.5, 0.3, 0.0}});
}

TEST(MeshBody, ComesToRestOnAPlaneWithinCentimetresAndSleeps) {
  for (const bool bounded : {false, true}) {
    World w;
    const FieldId g = addGravity(w);
    PlaneShape ground;
    if (bounded) ground.half = {50, 50};
    w.addCollider({w.addShape(ground), {}, {0.5, 0.3, 0.0}});
    const BodyId b = addMesh(w, g, ellMesh(), {{0, 0, 3}, Quat::Identity()});
    play(w, 2.5);
    const Vec3 early = w.state(b).p;
    play(w, 5);
    EXPECT_EQ(w.mode(b), BodyMode::Rest);
    EXPECT_LT((w.state(b).p - early).norm(), 0.02);
    EXPECT_GT(w.separation({true, b}, {false, 1}), -1e-4);
    EXPECT_LT(w.separation({true, b}, {false, 1}), 1e-4);
  }
}

TEST(MeshBody, WiderThanASheetItLiesOnTheSheetsRim) {
  World w;
  const FieldId g = addGravity(w);
  PlaneShape table;
  table.half = {0.2, 0.2};
  w.addCollider({w.addShape(table), {}, {0.5, 0.3, 0.0}});
  const BodyId b = addMesh(w, g, boxMesh({0.5, 0.5, 0.1}), {{0.02, 0.03, 0.4}, Quat::Identity()});
  play(w, 5);
  EXPECT_EQ(w.mode(b), BodyMode::Rest);
  EXPECT_NEAR(w.state(b).p.z(), 0.1, 1e-3);
}

/// Drops the meshes from a little above and says how far below their place they end, at worst.
TEST(MeshBody, LiesAtTheRightHeightOnFloorsOfTriangles) {
  const Mesh thick = boxMesh({10, 10, 0.5});
  const std::array<Mesh, 3> floors = {gridMesh(-10, 10, -10, 10, 40, 40), gridMesh(-10, 10, -10, 10, 1, 1),
                                      thick};
  const std::array<Mesh, 4> bodies = {boxMesh({0.5, 0.5, 0.5}), ellMesh(), ringMesh(0.2, 0.15, 0.05, 32),
                                      ballMesh(0.2, 10, 16)};
  const std::array<double, 4> half = {0.5, 0, 0.025, 0.2};
  for (std::size_t f = 0; f < floors.size(); ++f)
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      World w;
      const FieldId g = addGravity(w);
      addMeshFloor(w, floors[f], {{0, 0, f == 2 ? -0.5 : 0}, Quat::Identity()});
      const BodyId b = addMesh(w, g, bodies[i], {{0.3, 0.2, half[i] + 0.2}, Quat::Identity()});
      play(w, 6);
      EXPECT_EQ(w.mode(b), BodyMode::Rest) << f << " " << i;
      if (i < 3) {
        EXPECT_NEAR(w.state(b).pose.p.z(), half[i], 1e-3) << f << " " << i;
      } else {
        EXPECT_NEAR(w.state(b).pose.p.z(), half[i], 0.012) << f << " " << i;  // on a facet
      }
    }
}

TEST(MeshBody, ThrownAnyHowNothingFallsThroughASheetASlabOrADoubleSheet) {
  const Mesh grid = gridMesh(-10, 10, -10, 10, 40, 40);
  Mesh both = grid;
  for (std::size_t i = 0; i < grid.indices.size(); i += 3)
    both.indices.insert(both.indices.end(), {grid.indices[i], grid.indices[i + 2], grid.indices[i + 1]});
  const std::array<Mesh, 3> floors = {grid, both, boxMesh({10, 10, 0.01})};
  const std::array<Mesh, 3> bodies = {boxMesh({0.3, 0.2, 0.1}), ellMesh(), ringMesh(0.2, 0.15, 0.02, 16)};
  for (std::size_t f = 0; f < floors.size(); ++f)
    for (std::size_t i = 0; i < 9; ++i) {
      World w;
      const FieldId g = addGravity(w);
      const ColliderId floor = addMeshFloor(w, floors[f], {{0, 0, f == 2 ? -0.01 : 0}, Quat::Identity()});
      const auto k = static_cast<double>(i);
      const BodyId b =
          addMesh(w, g, bodies[i % 3], {{0.1 * k, 0, 1.5}, det::fromEuler(0.7 * k, 0.4 * k, 1.1 * k)});
      play(w, 6);
      EXPECT_EQ(w.mode(b), BodyMode::Rest) << f << " " << i;
      EXPECT_GT(w.separation({true, b}, {false, floor}), -1e-3) << f << " " << i;
      EXPECT_GT(w.state(b).p.z(), 0) << f << " " << i;
    }
}

TEST(MeshBody, ThatFallsOnABoxLiesOnIt) {
  // A face of the mesh that stands on the box like a wall is no way out of it: it slid there for ever.
  World w;
  const FieldId g = addGravity(w);
  w.addCollider({w.addShape(BoxShape{{}, {2, 2, 0.5}}), {{0, 0, -0.5}, Quat::Identity()}, {0.5, 0.3, 0.0}});
  const BodyId b = addMesh(w, g, ellMesh(), {{0, 0, 0.4}, Quat::Identity()});
  play(w, 6);
  EXPECT_EQ(w.mode(b), BodyMode::Rest);
  EXPECT_LT(w.state(b).p.head<2>().norm(), 1.5);
  EXPECT_GT(w.separation({true, b}, {false, 1}), -2e-4);
}

TEST(MeshBody, SlidesOverTheSeamsOfAnOpenFloorAsOverAPlane) {
  // The floor's vertices once stopped a mesh body's upright faces, though the floor is flat there.
  for (const bool oblique : {false, true}) {
    Vec3 end[2];
    for (const bool mesh : {false, true}) {
      World w;
      const FieldId g = addGravity(w);
      if (mesh)
        addMeshFloor(w, gridMesh(-5, 5, -5, 5, 50, 50));
      else
        w.addCollider({w.addShape(PlaneShape{}), {}, {0.5, 0.3, 0.0}});
      const BodyId b = addMesh(w, g, boxMesh({0.1, 0.1, 0.1}), {{-3, 0.03, 0.1}, Quat::Identity()}, 0.1, 0.3,
                               oblique ? Vec3(2, 1, 0) : Vec3(2.5, 0, 0));
      double highest = 0;
      play(w, 3, 60, [&](double) { highest = std::max(highest, w.state(b).p.z()); });
      EXPECT_LE(highest, 0.1 + 1e-5);
      end[mesh] = w.state(b).p;
    }
    EXPECT_LE((end[0] - end[1]).norm(), 1e-4) << oblique;
  }
}

TEST(MeshBody, AStackOfRingsRestsAndLooksNoFartherThanItMust) {
  World w;
  const FieldId g = addGravity(w);
  addFloor(w, 0.5, 0.3);
  const Mesh ring = ringMesh(0.09, 0.07, 0.006, 48);
  std::vector<BodyId> rings;
  for (int i = 0; i < 6; ++i)
    rings.push_back(addMesh(w, g, ring, {{0, 0, 0.003 + 0.0065 * i}, Quat::Identity()}));
  std::uint64_t most = 0, all = 0;
  play(w, 4, 60, [&](double) {
    const World::Counters& c = w.counters();
    most = std::max(most, c.distances + c.contactSteps), all += c.distances + c.contactSteps;
  });
  std::printf("  rings: %d looks in the busiest frame, %d in all\n", static_cast<int>(most),
              static_cast<int>(all));
  EXPECT_LT(most, 40000u);  // they once looked at each other without end
  for (std::size_t i = 0; i < rings.size(); ++i) {
    EXPECT_EQ(w.mode(rings[i]), BodyMode::Rest);
    EXPECT_NEAR(w.state(rings[i]).p.z(), 0.003 + 0.006 * static_cast<double>(i), 5e-4);
    EXPECT_LT(w.state(rings[i]).p.head<2>().norm(), 1e-3);
  }
}

}  // namespace
}  // namespace stadion
