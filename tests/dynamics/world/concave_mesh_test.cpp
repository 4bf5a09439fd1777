/// Closed meshes with hollows: other parts of the mesh that a body touches may be in its way as well.

#include "tests/dynamics/world/seams_scenes.h"

#include <gtest/gtest.h>

#include <random>

namespace stadion {
namespace {

using namespace scenes;

/// A box whose faces look inwards: a room seen from within.
void roomInto(Patchwork& mesh, const Vec3& half) {
  const std::size_t before = mesh.triangles.size();
  mesh.box(-half, half);
  for (std::size_t i = before; i < mesh.triangles.size(); ++i)
    std::swap(mesh.triangles[i][1], mesh.triangles[i][2]);
}

/// A wall x = 0 over a floor z = 0, in one piece.
Shape angle() {
  const std::array<Vec2, 6> outline{Vec2(-1, -1), Vec2(2, -1), Vec2(2, 0),
                                    Vec2(0, 0),   Vec2(0, 3),  Vec2(-1, 3)};  // (x, z)
  std::vector<std::array<Vec3, 3>> triangles;
  const auto at = [&](std::size_t i, double y) { return Vec3(outline[i % 6].x(), y, outline[i % 6].y()); };
  for (std::size_t i = 0; i < 6; ++i) {
    triangles.push_back({at(i, 2), at(i + 1, -2), at(i, -2)});
    triangles.push_back({at(i, 2), at(i + 1, 2), at(i + 1, -2)});
  }
  for (const auto& [a, b, c] : {std::array<std::size_t, 3>{0, 1, 3}, {1, 2, 3}, {0, 3, 5}, {3, 4, 5}}) {
    triangles.push_back({at(a, -2), at(b, -2), at(c, -2)});
    triangles.push_back({at(a, 2), at(c, 2), at(b, 2)});
  }
  return MeshShape(TriangleTree(triangles));
}

BodyDef cubeOf(World& w, Solid kind, double half) {
  BodyDef d = solidBody(w, kind, half, 1);
  if (kind == Solid::Box) d.shape = w.addShape(BoxShape{{}, Vec3::Constant(half)});
  if (kind == Solid::Mesh) d.shape = w.addShape(MeshShape(TriangleTree(boxMesh(Vec3::Constant(half)))));
  if (kind == Solid::Box || kind == Solid::Mesh) d.mass = massOfBox({}, Vec3::Constant(half), 1).withMass(1);
  d.surface = {0.0, 0.0, 0.0};
  return d;
}

TEST(ConcaveMesh, ABodyThatSlidesDownItsWallRestsOnItsFloor) {
  for (const Solid kind : {Solid::Box, Solid::Mesh, Solid::Ball})
    for (const double rate : {25.0, 60.0, 240.0})
      for (const double start : {0.25, 0.5}) {
        SCOPED_TRACE(std::string(nameOf(kind)) + " at " + std::to_string(rate));
        World w;
        const FieldId g = addGravity(w);
        w.addCollider({w.addShape(angle()), {}, {0.0, 0.0, 0.0}});
        BodyDef d = cubeOf(w, kind, 0.25);
        d.pose.p = {start, 0.1, 1.5};
        d.v = {-1, 0, 0};
        const BodyId b = addSolid(w, g, d);
        play(w, 2, rate);
        EXPECT_NEAR(w.state(b).p.z(), 0.25, 1e-4);
        EXPECT_LT(w.state(b).v.norm(), kind == Solid::Ball ? 2.0 : 1e-3);
      }
}

TEST(ConcaveMesh, NothingLeavesAClosedRoom) {
  for (const Solid kind : {Solid::Box, Solid::Mesh, Solid::Capsule, Solid::Cylinder, Solid::Ball})
    for (const bool hollow : {false, true})
      for (const Vec3& v : {Vec3(4, 0, 0), Vec3(4, 3.1, 0), Vec3(-3, 1, 9)}) {
        SCOPED_TRACE(std::string(nameOf(kind)) + (hollow ? " in a hollow box " : " in a room ") +
                     std::to_string(v.y()));
        World w;
        const FieldId g = addGravity(w);
        Patchwork mesh;
        roomInto(mesh, Vec3::Constant(1.8));
        if (hollow) mesh.box(Vec3::Constant(-2), Vec3::Constant(2));
        w.addCollider({w.addShape(mesh.shape()), {}, {0.0, 0.0, 0.0}});
        BodyDef d = cubeOf(w, kind, 0.3);
        d.pose.p = {0, 0.13, 0};
        d.v = v;
        const BodyId b = addSolid(w, g, d);
        double farthest = 0;
        play(w, 3, 60, [&](double) { farthest = std::max(farthest, w.pose(b).p.cwiseAbs().maxCoeff()); });
        EXPECT_LT(farthest, 1.8);
      }
}

// Its lowest corner touches three faces of the room. No contact may begin with the force of another one.
TEST(ConcaveMesh, ASlipperyBodyComesToRestInACorner) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (int run = 0; run < 40; ++run) {
    SCOPED_TRACE(run);
    World w;
    const FieldId g = addGravity(w);
    Patchwork mesh;
    roomInto(mesh, Vec3::Constant(1.8));
    if (run % 2) mesh.box(Vec3::Constant(-2), Vec3::Constant(2));
    w.addCollider({w.addShape(mesh.shape()), {}, {0.0, 0.0, 0.0}});
    BodyDef d = cubeOf(w, Solid::Mesh, 0.3);
    d.pose.p = {0.5 * unit(random), 0.5 * unit(random), 0.5 * unit(random)};
    d.v = {4 * unit(random), 4 * unit(random), 2 * unit(random)};
    const BodyId b = addSolid(w, g, d);
    double farthest = 0;
    play(w, 4, run % 4 < 2 ? 25 : 60,
         [&](double) { farthest = std::max(farthest, w.pose(b).p.cwiseAbs().maxCoeff()); });
    EXPECT_LT(farthest, 1.5 + 2e-5);
    if (w.pose(b).p.head<2>().cwiseAbs().minCoeff() > 1.499) {
      EXPECT_LT(w.state(b).v.norm(), 1e-3);
    }
  }
}

TEST(ConcaveMesh, EachWallThatIsPassedIsMetAtEveryRate) {
  for (const double rate : {25.0, 60.0, 97.0, 240.0}) {
    World w;
    Patchwork mesh;
    roomInto(mesh, Vec3::Constant(1.8));
    mesh.box(Vec3::Constant(-2), Vec3::Constant(2));
    w.addCollider({w.addShape(mesh.shape()), {}, {}});
    BodyDef d;
    d.shape = w.addShape(BallShape{Vec3::Zero(), 0.2});
    d.pose.p = {0.3, -30, 0.2};
    d.releaseDistance = 0.1;
    const BodyId b = w.addBody(d);
    w.holdBody(b);
    std::vector<double> impacts, releases;
    for (std::uint64_t i = 1; i <= static_cast<std::uint64_t>(0.4 * rate); ++i) {
      const TimeSignature s = signatureAt(i, rate);
      w.moveHeld(b, {{0.3, -30 + 200 * toSeconds(s.time), 0.2}, Quat::Identity()}, false);
      w.advance(s.time - s.step, s.time);
      for (const ContactEvent& e : w.events())
        (e.kind == ContactEvent::Kind::Impact ? impacts : releases).push_back(toSeconds(e.time));
    }
    std::ranges::sort(releases);
    SCOPED_TRACE(rate);
    ASSERT_EQ(impacts.size(), 2u);
    ASSERT_EQ(releases.size(), 2u);
    EXPECT_NEAR(impacts[0], (30 - 2.2) / 200, 2e-9);
    EXPECT_NEAR(releases[0], (30 - 1.8 + 0.3) / 200, 2e-9);
    EXPECT_NEAR(impacts[1], (30 + 1.6) / 200, 2e-9);
    EXPECT_NEAR(releases[1], (30 + 2.3) / 200, 2e-9);
  }
}

}  // namespace
}  // namespace stadion
