/// Bodies let go while they are partly or wholly inside something: they come out, at a bounded speed, without
/// energy from nowhere, and rest on it.

#include "engine/maths/functions.h"
#include "tests/dynamics/world/sampled.h"
#include "tests/dynamics/world/watch.h"

#include <gtest/gtest.h>

namespace stadion {
namespace {

using namespace scenes;

/// What a body is let go inside of. Its surface is at z = 0, or within 0.1 m of it (Hills).
enum class Ground { Plane, Sheet, TwoTriangles, Grid, Hills, Solid };
constexpr std::array kGrounds{Ground::Plane, Ground::Sheet, Ground::TwoTriangles,
                              Ground::Grid,  Ground::Hills, Ground::Solid};

const char* nameOf(Ground g) {
  static constexpr std::array names{"plane", "sheet", "two triangles", "grid", "hills", "solid mesh"};
  return names[static_cast<std::size_t>(g)];
}

double hillAt(double x, double y) {
  return 0.1 * std::sin(0.7 * x) * std::cos(0.9 * y);
}

/// An earth as shows have it, far larger on one side than on the other.
ColliderId addGround(World& w, Ground kind) {
  const Surface surface{0.5, 0.2, 0.05};
  switch (kind) {
  case Ground::Plane: return w.addCollider({w.addShape(PlaneShape{}), {}, surface});
  case Ground::Sheet:
    return w.addCollider({w.addShape(PlaneShape{{{0, -97, 0}, Quat::Identity()}, {70, 163}}), {}, surface});
  case Ground::TwoTriangles:
    return w.addCollider(
        {w.addShape(MeshShape(TriangleTree(gridMesh(-70, 70, -260, 66, 1, 1)))), {}, surface});
  case Ground::Grid:
    return w.addCollider(
        {w.addShape(MeshShape(TriangleTree(gridMesh(-10, 10, -10, 10, 40, 40)))), {}, surface});
  case Ground::Hills: {
    Mesh m = gridMesh(-10, 10, -10, 10, 40, 40);
    for (auto& p : m.positions) p[2] = static_cast<float>(hillAt(double(p[0]), double(p[1])));
    return w.addCollider({w.addShape(MeshShape(TriangleTree(m))), {}, surface});
  }
  case Ground::Solid:
    return w.addCollider(
        {w.addShape(MeshShape(TriangleTree(boxMesh({10, 10, 1})))), {{0, 0, -1}, Quat::Identity()}, surface});
  }
  return 0;
}

/// A pole that tapers to both ends, its nose along x, 1.05 m before its centre of mass.
BodyDef pole(World& w) {
  std::vector<Vec3> corners{{1.05, 0, 0}, {-1.6, 0, 0}};
  for (int i = 0; i < 8; ++i)
    for (const double x : {0.8, -0.2, -1.2})
      corners.emplace_back(x, 0.015 * std::cos(M_PI * i / 4), 0.015 * std::sin(M_PI * i / 4));
  BodyDef d;
  d.shape = w.addShape(*convexHull(corners));
  d.mass.mass = 0.806, d.mass.inertia = {0.00015, 0.42, 0.42};
  d.surface = {0.6, 0.2, 0.05};
  return d;
}

BodyDef disc(World& w) {
  BodyDef d;
  d.shape = w.addShape(CylinderShape{{}, 0.11, 0.0165});
  d.mass = massOfRound(0.11, 0.0165, 2);
  d.surface = {0.5, 0.2, 0.35};
  return d;
}

/// How deep the body's lowest point is below z = 0.
double sunk(BodyDef (*make)(World&), const Pose& at) {
  World w;
  BodyDef d = make(w);
  d.pose = at;
  const ColliderId plane = w.addCollider({w.addShape(PlaneShape{}), {}, {}});
  const BodyId b = w.addBody(d);
  w.advance(0, 0);
  return std::max(0.0, -w.separation({true, b}, {false, plane}));
}

/// A body that a hand carries in a second from `from` to `to` and lets go of there, turned the same way.
struct LetGo {
  World w;
  ColliderId ground = 0;
  BodyId body = 0;
  std::uint64_t frame = 0;

  template <class Make>
  LetGo(Ground kind, Make make, const Vec3& from, const Pose& to, const Vec3& v = Vec3::Zero()) {
    ground = addGround(w, kind);
    BodyDef d = make(w);
    d.pose = {from, to.q};
    body = addSolid(w, addGravity(w), d);
    w.advance(0, 0);
    w.holdBody(body);
    carry(from, to.p, to.q);
    w.releaseBody(body, v, Vec3::Zero());
  }
  void carry(const Vec3& from, const Vec3& to, const Quat& q) {
    for (int i = 1; i <= 60; ++i) {
      w.moveHeld(body, {from + i / 60.0 * (to - from), q});
      next();
    }
  }
  void next() {
    const TimeSignature s = signatureAt(++frame, 60);
    w.advance(s.time - s.step, s.time);
  }
  /// Looks on until it sleeps, or for so long.
  Watch watch(double seconds) {
    Watch watch(w, {body});
    for (int i = 0; i < 60 * seconds && !watch.asleep(); ++i) next(), watch.look();
    return watch;
  }
  double separation() const { return w.separation({true, body}, {false, ground}); }
};

Quat pitched(double degrees) {  // the nose down
  return det::fromEuler(0, 0, M_PI / 2) * det::expRotation(Vec3(0, degrees * M_PI / 180, 0));
}

/// Lowered from above to z and let go, it comes out no faster than it would fall over, brings no more energy
/// than it takes to lift it out, and lies on the ground.
void expectOnTop(Ground ground, BodyDef (*make)(World&), const Pose& at, const std::string& name,
                 int number) {
  if (!isPlayed(number)) return;
  const std::string what = name + " at " + std::to_string(at.p.z()) + " in " + nameOf(ground);
  LetGo scene(ground, make, at.p + Vec3(0, 0, 3), at);
  const Watch watch = scene.watch(20);
  const double hill = ground == Ground::Hills ? 0.1 : 0;
  EXPECT_TRUE(watch.finite && watch.limited == 0) << what;
  EXPECT_LE(watch.greatestGain, scene.w.mass(scene.body) * kG * (sunk(make, at) + hill + 0.01)) << what;
  EXPECT_LE(watch.fastest, 4) << what;
  EXPECT_GE(scene.separation(), -1e-3) << what;
  EXPECT_GE(scene.w.state(scene.body).p.z(), -hill) << what;
  const bool rocks = ground == Ground::Hills && name == "mesh";  // on the edges of a mesh a mesh trembles on
  EXPECT_TRUE(watch.asleep() || rocks) << what;
}

TEST(LetGo, APoleWithItsTipInTheGroundComesOutAndLiesOnIt) {
  int n = 0;
  for (const Ground ground : kGrounds)
    for (const double z : {0.98, 0.7, 0.3, -0.1})
      for (const double pitch : {80., 60., 45., -60.})
        expectOnTop(ground, pole, {{0.31, 0.17, z}, pitched(pitch)},
                    "pole " + std::to_string(static_cast<int>(pitch)), n++);
}

TEST(LetGo, ADiscComesOutAlsoWhereAllOfItHasGoneThroughTheGround) {
  int n = 0;
  for (const Ground ground : kGrounds)
    for (const double z : {0.015, 0.0, -0.02, -0.15})
      for (const double pitch : {0., 20., 90.})
        expectOnTop(ground, disc, {{0.31, 0.17, z}, pitched(pitch)},
                    "disc " + std::to_string(static_cast<int>(pitch)), n++);
}

template <Solid kind>
BodyDef solid(World& w) {
  BodyDef d = solidBody(w, kind, 0.2, 1);
  d.surface = {0.5, 0.2, 0.05};
  return d;
}

TEST(LetGo, EverySolidComesOut) {
  int n = 0;
  for (const Ground ground : kGrounds)
    for (const double z : {0.1, 0.0, -0.1}) {
      const Pose at{{0.31, 0.17, z}, det::fromEuler(0.3, 0.4, 0.5)};
      expectOnTop(ground, solid<Solid::Ball>, at, "ball", n++);
      expectOnTop(ground, solid<Solid::Box>, at, "box", n++);
      expectOnTop(ground, solid<Solid::Capsule>, at, "capsule", n++);
      expectOnTop(ground, solid<Solid::Cylinder>, at, "cylinder", n++);
      expectOnTop(ground, solid<Solid::Convex>, at, "convex", n++);
      expectOnTop(ground, solid<Solid::Mesh>, at, "mesh", n++);
    }
}

TEST(LetGo, WhatWasHeldBelowASheetFallsFromThere) {
  for (const Ground ground : {Ground::TwoTriangles, Ground::Grid, Ground::Hills})
    for (const auto make : {disc, solid<Solid::Box>, solid<Solid::Convex>})
      for (const double z : {-0.4, -0.05}) {  // clear of it, and with its upper side in it
        LetGo scene(ground, make, {0, 0, -2}, {{0, 0, z}, Quat::Identity()});
        const Watch watch = scene.watch(2);
        EXPECT_LT(scene.w.state(scene.body).p.z(), -10) << nameOf(ground) << z;
        EXPECT_LE(watch.greatestGain, 0.05) << nameOf(ground) << z;
      }
}

TEST(LetGo, InsideOfAStandItComesOutOnTop) {
  for (const bool hull : {false, true})
    for (const double z : {0.9, 0.5, 0.1})
      for (const auto make : {disc, solid<Solid::Box>}) {
        World w;
        addGround(w, Ground::Sheet);
        const Vec3 half(0.24, 0.24, 0.475);
        std::vector<Vec3> corners;
        for (int i = 0; i < 8; ++i)
          corners.push_back(half.cwiseProduct(Vec3(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1)));
        const ShapeId shape = hull ? w.addShape(*convexHull(corners)) : w.addShape(BoxShape{{}, half});
        w.addCollider({shape, {{0, 0, half.z()}, Quat::Identity()}, {0.5, 0.2, 0.05}});
        BodyDef d = make(w);
        d.pose.p = {0.03, 0.02, 2};
        const BodyId b = addSolid(w, addGravity(w), d);
        w.advance(0, 0);
        w.holdBody(b);
        Watch watch(w, {b});
        for (std::uint64_t n = 1; n < 900; ++n) {
          const TimeSignature s = signatureAt(n, 60);
          if (n <= 60) w.moveHeld(b, {{0.03, 0.02, 2 + (z - 2) * toSeconds(s.time)}, Quat::Identity()});
          if (n == 61) w.releaseBody(b, Vec3::Zero(), Vec3::Zero());
          w.advance(s.time - s.step, s.time);
          if (n > 60) watch.look();
        }
        EXPECT_LE(watch.fastest, 0.5) << hull << z;
        EXPECT_GE(w.state(b).p.z(), 0.95) << hull << z;
        EXPECT_TRUE(watch.asleep()) << hull << z;
      }
}

TEST(LetGo, ThrownUpWithItsTailInTheGroundItFlies) {
  for (const Ground ground : kGrounds)
    for (const double v : {5., 15.}) {
      const Pose at{{0.31, 0.17, 0.7}, pitched(-60)};
      LetGo scene(ground, pole, at.p + Vec3(0, 0, 3), at, pitched(-60) * Vec3(v, 0, 0));
      const double up = v * std::sin(M_PI / 3), t = 0.4;
      for (int i = 0; i < 24; ++i) scene.next();
      EXPECT_NEAR(scene.w.state(scene.body).p.z(), 0.7 + up * t - 0.5 * kG * t * t, 1e-3)
          << nameOf(ground) << v;
    }
}

}  // namespace
}  // namespace stadion
