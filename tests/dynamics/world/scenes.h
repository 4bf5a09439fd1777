#pragma once
/// Worlds that the tests of dynamics share. Up is +Z; g = 9.81 as in the published cases, not a
/// show's 9.80665.

#include "dynamics/world/world.h"

#include <array>
#include <cmath>

namespace stadion::scenes {

constexpr double kG = 9.81;

inline FieldId addGravity(World& w, const Vec3& g = Vec3(0, 0, -kG)) {
  ForceField f;
  f.law = LinearField{g, LinearField::Unit::Acceleration};
  return w.addField(f, true);
}

struct BallSpec {
  double radius = 0.1, mass = 1;
  Vec3 p = Vec3::Zero(), v = Vec3::Zero(), omega = Vec3::Zero();
  double restitution = 0, friction = 0, rolling = 0, damping = 0;
};

inline BodyId addBall(World& w, FieldId gravity, const BallSpec& s) {
  BodyDef d;
  d.shape = w.addShape(BallShape{Vec3::Zero(), s.radius});
  d.pose.p = s.p, d.v = s.v, d.omega = s.omega;
  d.mass = massOfSphere(Vec3::Zero(), s.radius, 1).withMass(s.mass);
  d.surface = {s.friction, s.restitution, s.rolling};
  d.damping = s.damping;
  const BodyId id = w.addBody(d);
  if (gravity) w.hook(id, gravity, 0);
  return id;
}

struct BoxSpec {
  Vec3 half = Vec3::Constant(0.5);
  double mass = 1;
  Pose pose = {};
  Vec3 v = Vec3::Zero(), omega = Vec3::Zero();
  double restitution = 0, friction = 0;
};

inline BodyId addBox(World& w, FieldId gravity, const BoxSpec& s) {
  BodyDef d;
  d.shape = w.addShape(BoxShape{{}, s.half});
  d.pose = s.pose, d.v = s.v, d.omega = s.omega;
  d.mass = massOfBox({}, s.half, 1).withMass(s.mass);
  d.surface = {s.friction, s.restitution, 0.0};
  const BodyId id = w.addBody(d);
  if (gravity) w.hook(id, gravity, 0);
  return id;
}

inline ColliderId addFloor(World& w, double friction = 0, double restitution = 0) {
  return w.addCollider({w.addShape(PlaneShape{}), {}, {friction, restitution, 0.0}});
}

/// Calls `each(seconds)` after every frame until `seconds` have passed.
template <class F>
void play(World& w, double seconds, double rate, F each) {
  const auto n = static_cast<std::uint64_t>(seconds * rate + 0.5);
  static constexpr double kStart = 0;
  (void)kStart;
  for (std::uint64_t i = 1; i <= n; ++i) {
    const TimeSignature s = signatureAt(i, rate);
    w.advance(s.time - s.step, s.time);
    each(toSeconds(s.time));
  }
}

inline void play(World& w, double seconds, double rate = 60) {
  play(w, seconds, rate, [](double) {});
}

inline Mesh meshOf(const std::vector<Vec3>& points,
                   const std::vector<std::array<std::uint32_t, 3>>& triangles) {
  Mesh m;
  for (const Vec3& p : points)
    m.positions.push_back({static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z())});
  for (const auto& t : triangles) m.indices.insert(m.indices.end(), t.begin(), t.end());
  return m;
}

inline Mesh boxMesh(const Vec3& half) {
  std::vector<Vec3> p;
  for (int i = 0; i < 8; ++i)
    p.emplace_back((i & 1 ? 1 : -1) * half.x(), (i & 2 ? 1 : -1) * half.y(), (i & 4 ? 1 : -1) * half.z());
  return meshOf(p, {{0, 4, 6},
                    {0, 6, 2},
                    {1, 3, 7},
                    {1, 7, 5},
                    {0, 1, 5},
                    {0, 5, 4},
                    {2, 6, 7},
                    {2, 7, 3},
                    {0, 2, 3},
                    {0, 3, 1},
                    {4, 5, 7},
                    {4, 7, 6}});
}

/// A flat grid at height z facing up.
inline Mesh gridMesh(double x0, double x1, double y0, double y1, int nx, int ny, double z = 0) {
  std::vector<Vec3> p;
  std::vector<std::array<std::uint32_t, 3>> t;
  for (int j = 0; j <= ny; ++j)
    for (int i = 0; i <= nx; ++i) p.emplace_back(x0 + (x1 - x0) * i / nx, y0 + (y1 - y0) * j / ny, z);
  const auto id = [&](int i, int j) { return static_cast<std::uint32_t>(j * (nx + 1) + i); };
  for (int j = 0; j < ny; ++j)
    for (int i = 0; i < nx; ++i) {
      t.push_back({id(i, j), id(i + 1, j), id(i, j + 1)});
      t.push_back({id(i + 1, j), id(i + 1, j + 1), id(i, j + 1)});
    }
  return meshOf(p, t);
}

/// Latitude-longitude ball.
inline Mesh ballMesh(double radius, int rings, int sectors, const Vec3& centre = Vec3::Zero()) {
  std::vector<Vec3> p{centre + Vec3(0, 0, radius)};
  for (int i = 1; i < rings; ++i)
    for (int j = 0; j < sectors; ++j) {
      const double a = M_PI * i / rings, b = 2 * M_PI * j / sectors;
      p.push_back(centre + radius * Vec3(std::sin(a) * std::cos(b), std::sin(a) * std::sin(b), std::cos(a)));
    }
  p.push_back(centre - Vec3(0, 0, radius));
  std::vector<std::array<std::uint32_t, 3>> t;
  const auto at = [&](int i, int j) {
    return i == 0       ? 0u
           : i == rings ? static_cast<std::uint32_t>(p.size() - 1)
                        : static_cast<std::uint32_t>(1 + (i - 1) * sectors + j % sectors);
  };
  for (int i = 0; i < rings; ++i)
    for (int j = 0; j < sectors; ++j) {
      if (i > 0) t.push_back({at(i, j), at(i + 1, j), at(i, j + 1)});
      if (i < rings - 1) t.push_back({at(i, j + 1), at(i + 1, j), at(i + 1, j + 1)});
    }
  return meshOf(p, t);
}

}  // namespace stadion::scenes
