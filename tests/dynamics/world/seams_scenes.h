#pragma once
/// Floors and walls of flush pieces, and bodies that slide or roll over them.

#include "tests/dynamics/world/watch.h"

#include <string>

namespace stadion::scenes {

/// What the pieces of a floor are made of.
enum class Ground { Boxes, Convexes, Sheets, ClosedMeshes, OpenMeshes, OneMesh, Grid, Junctions, Mixed };
inline constexpr std::array kGrounds{Ground::Boxes,        Ground::Convexes,   Ground::Sheets,
                                     Ground::ClosedMeshes, Ground::OpenMeshes, Ground::OneMesh,
                                     Ground::Grid,         Ground::Junctions,  Ground::Mixed};
inline const char* nameOf(Ground g) {
  static constexpr std::array names{"boxes",    "convexes", "sheets",    "closed meshes", "open meshes",
                                    "one mesh", "grid",     "junctions", "mixed"};
  return names[static_cast<std::size_t>(g)];
}

/// How a body lies on the floor.
enum class Slider { Box, Convex, Mesh, Disc, RodAlong, CapsuleAlong, Ball, RodAcross, CapsuleAcross };
inline constexpr std::array kSliders{Slider::Box,  Slider::Convex,    Slider::Mesh,
                                     Slider::Disc, Slider::RodAlong,  Slider::CapsuleAlong,
                                     Slider::Ball, Slider::RodAcross, Slider::CapsuleAcross};
inline const char* nameOf(Slider s) {
  static constexpr std::array names{"box",           "convex", "mesh",       "disc",          "rod along",
                                    "capsule along", "ball",   "rod across", "capsule across"};
  return names[static_cast<std::size_t>(s)];
}
inline bool rolls(Slider s) {
  return s == Slider::Ball || s == Slider::RodAcross || s == Slider::CapsuleAcross;
}

/// A body with its middle 0.25 m above the floor at the origin, in the axes of the scene.
inline BodyDef slider(World& w, Slider kind) {
  BodyDef d;
  const double r = 0.25, half = 0.3;
  std::vector<Vec3> corners;
  for (int i = 0; i < 8; ++i) corners.emplace_back((i & 1 ? r : -r), (i & 2 ? r : -r), (i & 4 ? r : -r));
  const Quat along(Eigen::AngleAxisd(M_PI / 2, Vec3::UnitX())),
      across(Eigen::AngleAxisd(M_PI / 2, Vec3::UnitY()));
  d.mass = massOfBox({}, Vec3::Constant(r), 1).withMass(20);
  switch (kind) {
  case Slider::Box: d.shape = w.addShape(BoxShape{{}, Vec3::Constant(r)}); break;
  case Slider::Convex: d.shape = w.addShape(*convexHull(corners)); break;
  case Slider::Mesh: d.shape = w.addShape(MeshShape(TriangleTree(boxMesh(Vec3::Constant(r))))); break;
  case Slider::Disc: d.shape = w.addShape(CylinderShape{{}, half, r}); break;
  case Slider::RodAlong:
  case Slider::RodAcross: d.shape = w.addShape(CylinderShape{{}, r, half}); break;
  case Slider::CapsuleAlong:
  case Slider::CapsuleAcross: d.shape = w.addShape(CapsuleShape{{}, r, half}); break;
  case Slider::Ball: d.shape = w.addShape(BallShape{Vec3::Zero(), r}); break;
  }
  if (kind == Slider::Disc) d.mass = massOfRound(half, r, 20);
  if (kind == Slider::RodAlong || kind == Slider::RodAcross) d.mass = massOfRound(r, half, 20);
  if (kind == Slider::CapsuleAlong || kind == Slider::CapsuleAcross) d.mass = massOfRound(r, half, 20);
  if (kind == Slider::Ball) d.mass = massOfSphere(Vec3::Zero(), r, 1).withMass(20);
  if (kind == Slider::RodAlong || kind == Slider::CapsuleAlong) d.pose.q = along;
  if (kind == Slider::RodAcross || kind == Slider::CapsuleAcross) d.pose.q = across;
  d.pose.p.z() = r;
  return d;
}

/// Boxes and grids collected into one mesh.
struct Patchwork {
  std::vector<std::array<Vec3, 3>> triangles;
  void box(const Vec3& lo, const Vec3& hi) {
    const Mesh m = boxMesh(Vec3::Ones());
    const Vec3 half = 0.5 * (hi - lo), middle = 0.5 * (hi + lo);
    for (std::size_t i = 0; i + 2 < m.indices.size(); i += 3) {
      auto& t = triangles.emplace_back();
      for (std::size_t k = 0; k < 3; ++k) {
        const auto& p = m.positions[m.indices[i + k]];
        t[k] = middle + half.cwiseProduct(Vec3(p[0], p[1], p[2]));
      }
    }
  }
  void sheet(double x0, double x1, double y0, double y1, int nx, int ny, double z = 0) {
    const auto at = [&](int i, int j) { return Vec3(x0 + (x1 - x0) * i / nx, y0 + (y1 - y0) * j / ny, z); };
    for (int j = 0; j < ny; ++j)
      for (int i = 0; i < nx; ++i) {
        triangles.push_back({at(i, j), at(i + 1, j), at(i, j + 1)});
        triangles.push_back({at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
      }
  }
  Shape shape() const { return MeshShape(TriangleTree(triangles)); }
};

/// One piece of a floor: the rectangle from (x0, y0) to (x1, y1) at z.
inline ColliderId addPiece(World& w, Ground kind, const Pose& frame, double x0, double x1, double y0,
                           double y1, double z, const Surface& surface) {
  const Vec3 half(0.5 * (x1 - x0), 0.5 * (y1 - y0), 0.5);
  const Pose pose = frame * Pose{{0.5 * (x0 + x1), 0.5 * (y0 + y1), z - 0.5}, Quat::Identity()};
  const auto corners = [&] {
    std::vector<Vec3> p;
    for (int i = 0; i < 8; ++i)
      p.emplace_back((i & 1 ? 1 : -1) * half.x(), (i & 2 ? 1 : -1) * half.y(), (i & 4 ? 1 : -1) * half.z());
    return p;
  };
  Patchwork mesh;
  switch (kind) {
  case Ground::Convexes: return w.addCollider({w.addShape(*convexHull(corners())), pose, surface});
  case Ground::Sheets:
    return w.addCollider(
        {w.addShape(PlaneShape{{{0, 0, 0.5}, Quat::Identity()}, {half.x(), half.y()}}), pose, surface});
  case Ground::ClosedMeshes:
    mesh.box(-half, half);
    return w.addCollider({w.addShape(mesh.shape()), pose, surface});
  case Ground::OpenMeshes:
    mesh.sheet(-half.x(), half.x(), -half.y(), half.y(), 2, 3, 0.5);
    return w.addCollider({w.addShape(mesh.shape()), pose, surface});
  default: return w.addCollider({w.addShape(BoxShape{{}, half}), pose, surface});
  }
}

/// A floor of rows of tiles, `lx` by `ly`, from (-1.7, -1.3) on; `single`: one piece of about the kind
/// instead.
inline void addFloorOf(World& w, Ground kind, const Pose& frame, const Surface& surface, bool single,
                       double lx = 1.1, double ly = 0.35, int nx = 3, int ny = 12) {
  const double x0 = -1.7, y0 = -1.3;
  if (single) {
    const Ground whole = kind == Ground::OneMesh                             ? Ground::ClosedMeshes
                         : kind == Ground::Grid || kind == Ground::Junctions ? Ground::OpenMeshes
                                                                             : kind;
    addPiece(w, whole, frame, x0, x0 + nx * lx, y0, y0 + ny * ly, 0, surface);
    return;
  }
  Patchwork mesh;
  static constexpr std::array kinds{Ground::Boxes, Ground::ClosedMeshes, Ground::Convexes, Ground::Sheets,
                                    Ground::OpenMeshes};
  for (int j = 0; j < ny; ++j)
    for (int i = 0; i < nx; ++i) {
      const double a = x0 + i * lx, b = y0 + j * ly;
      if (kind == Ground::OneMesh) {
        mesh.box({a, b, -1}, {a + lx, b + ly, 0});
      } else if (kind == Ground::Grid || kind == Ground::Junctions) {
        const int n = kind == Ground::Grid ? 2 : 1 + (i + 2 * j) % 3;
        mesh.sheet(a, a + lx, b, b + ly, n, n);
      } else {
        const Ground k =
            kind == Ground::Mixed ? kinds[static_cast<std::size_t>(i + 3 * j) % kinds.size()] : kind;
        addPiece(w, k, frame, a, a + lx, b, b + ly, 0, surface);
      }
    }
  if (!mesh.triangles.empty()) w.addCollider({w.addShape(mesh.shape()), frame, surface});
}

/// What a body did, seen in the axes of the scene.
struct Slid {
  Vec3 end = Vec3::Zero();  ///< where it is in the end [m]
  double lowest = 1e9, highest = -1e9, turned = 0;
  std::size_t events = 0;
  std::uint64_t steps = 0, arcs = 0;
};

inline Slid watchSlide(World& w, BodyId b, const Pose& frame, double seconds, double rate) {
  Slid s;
  const Quat q0 = w.pose(b).q;
  play(w, seconds, rate, [&](double) {
    const BodyState now = w.state(b);
    const Vec3 p = frame.inverse() * now.p;
    s.lowest = std::min(s.lowest, p.z()), s.highest = std::max(s.highest, p.z());
    s.turned = std::max(s.turned, 2 * (w.pose(b).q.coeffs() - q0.coeffs()).norm());
    s.events += w.events().size();
    s.steps += w.counters().contactSteps, s.arcs += w.counters().arcs;
    s.end = p;
  });
  return s;
}

}  // namespace stadion::scenes
