#include "dynamics/polyhedra.h"

#include "dynamics/box_manifold.h"
#include "dynamics/mesh_distance.h"
#include "dynamics/touch.h"
#include "dynamics/triangle_distance.h"

#include <algorithm>
#include <cmath>

namespace stadion {
namespace {

constexpr double kNear = 1e-6;   ///< meshes closer than this touch [m]
constexpr double kLeast = 1e-5;  ///< least motion between two looks at a pair that parts [m]
constexpr int kMostLooks = 400;

Vec3 cornerOf(const BoxShape& b, int i) {
  return b.pose *
         Vec3((i & 1 ? 1 : -1) * b.half.x(), (i & 2 ? 1 : -1) * b.half.y(), (i & 4 ? 1 : -1) * b.half.z());
}

Gap boxGap(const BoxShape& a, const Pose& X_WA, const BoxShape& b, const Pose& X_WB) {
  const Pose A = X_WA * a.pose, B = X_WB * b.pose;
  Gap best;
  Vec3 axis = Vec3::UnitZ();
  bool edges = false;
  const double s = separatingAxis(A, a.half, B, b.half, axis, edges);
  if (s <= 0) {
    const Vec3 deep = (A.q.conjugate() * axis);
    Vec3 x = A.p;  // a's deepest corner along the axis
    for (int i = 0; i < 3; ++i)
      x -= A.q * Vec3::Unit(i) * (deep[i] > 0 ? a.half[i] : deep[i] < 0 ? -a.half[i] : 0);
    return {s, x, axis, false, -1};
  }
  const auto offer = [&](double distance, const Vec3& onA, const Vec3& onB) {
    if (distance < best.distance && distance > 0) best = {distance, onB, (onA - onB) / distance, false, -1};
  };
  const BoxShape la{{}, a.half}, lb{{}, b.half};
  for (int i = 0; i < 8; ++i) {
    const Vec3 x = A * cornerOf(la, i), y = B * cornerOf(lb, i);
    const Vec3 onB = B * (B.inverse() * x).cwiseMin(b.half).cwiseMax(-b.half);
    const Vec3 onA = A * (A.inverse() * y).cwiseMin(a.half).cwiseMax(-a.half);
    offer((x - onB).norm(), x, onB), offer((onA - y).norm(), onA, y);
  }
  for (int i = 0; i < 12; ++i) {
    const auto edge = [](const Pose& X, const Vec3& h, int k, Vec3& p, Vec3& d) {
      const int axisOf = k / 4, u = (axisOf + 1) % 3, v = (axisOf + 2) % 3;
      Vec3 l = Vec3::Zero();
      l[axisOf] = -h[axisOf], l[u] = k & 1 ? h[u] : -h[u], l[v] = k & 2 ? h[v] : -h[v];
      p = X * l, d = X.q * Vec3(2 * h[axisOf] * Vec3::Unit(axisOf));
    };
    Vec3 p, d;
    edge(A, a.half, i, p, d);
    for (int j = 0; j < 12; ++j) {
      Vec3 q, e;
      edge(B, b.half, j, q, e);
      const NearestPoints n = nearestOfSegments(p, d, q, e);
      offer(n.distance, n.a, n.b);
    }
  }
  return best;
}

std::vector<Triangle> trianglesOf(const BoxShape& b) {
  static constexpr int quads[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                                      {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
  std::vector<Triangle> out;
  for (const auto& q : quads)
    for (const int k : {1, 2}) {
      Triangle t;
      t.v = {cornerOf(b, q[0]), cornerOf(b, q[k]), cornerOf(b, q[k + 1])};
      t.normal = (t.v[1] - t.v[0]).cross(t.v[2] - t.v[0]).normalized();
      t.next = {-1, -1, -1}, t.merged = {false, false, false};
      out.push_back(t);
    }
  return out;
}

Triangle moved(const Triangle& t, const Pose& X) {
  Triangle m = t;
  for (Vec3& v : m.v) v = X * v;
  m.normal = X.q * t.normal;
  return m;
}

Gap gapOf(const Triangle& a, const Triangle& b) {
  const NearestPoints n = nearestOfTriangles(a, b);
  if (n.distance > 0) return {n.distance, n.b, (n.a - n.b) / n.distance, false, -1};
  return {0, n.b, b.normal, false, -1};
}

/// A box's triangles against those of the mesh that are near it; normal from the mesh to the box.
Gap boxOnMesh(const BoxShape& box, const Pose& X_WA, const MeshShape& mesh, const Pose& X_WB, double limit) {
  const Pose X = X_WB.inverse() * X_WA;  // box's node in the mesh's
  Gap best;
  std::vector<std::uint32_t> near;
  const std::vector<Triangle> faces = trianglesOf(box);
  // Look close by first, then as far as the limit or the nearest so far asks for.
  const double size = box.half.norm();
  for (double reach = std::min(limit, 0.1 * size + 1e-3);; reach = std::min(limit, reach * 8)) {
    Aabb b;
    for (int i = 0; i < 8; ++i) b.include(X * cornerOf(box, i));
    b.lo.array() -= reach, b.hi.array() += reach;
    mesh.tree.overlapping(b, near);
    for (const Triangle& f : faces) {
      const Triangle t = moved(f, X);
      for (const std::uint32_t i : near) {
        const Gap g = gapOf(t, mesh.tree.triangles()[i]);
        if (g.distance < best.distance) best = g, best.triangle = static_cast<std::int32_t>(i);
      }
    }
    if (best.distance <= reach || reach >= limit || near.size() == mesh.tree.triangles().size() ||
        reach > 1e6)
      break;
  }
  best.point = X_WB * best.point, best.normal = X_WB.q * best.normal;
  return best;
}

Gap meshGap(const MeshShape& a, const Pose& X_WA, const MeshShape& b, const Pose& X_WB) {
  const auto pair = MeshHierarchy::nearest(*a.hierarchy, X_WA, *b.hierarchy, X_WB);
  if (!pair) return {0, X_WB * b.tree.bounds().centre(), (X_WA.p - X_WB.p).normalized(), false, -1};
  const Pose X = X_WB.inverse() * X_WA;
  Gap g = gapOf(moved(a.tree.triangles()[pair->a], X), b.tree.triangles()[pair->b]);
  if (pair->crossing) g.distance = std::min(g.distance, 0.0);
  g.point = X_WB * g.point, g.normal = X_WB.q * g.normal;
  g.triangle = static_cast<std::int32_t>(pair->b);
  return g;
}

/// Seconds in which no corner of the two boxes can reach the plane between them (see touch.h for the bound).
double safeStep(const Side& side, const Kinematics& k, const BoxShape& box, const Vec3& n, const Vec3& middle,
                const Vec3& planeVelocity, double acceleration) {
  double least = 1e300;
  for (int i = 0; i < 8; ++i) {
    const Vec3 x = k.pose * cornerOf(box, i);
    const double g = std::max(0.0, n.dot(x - middle)), u = n.dot(k.velocityAt(x) - planeVelocity);
    const double root = std::sqrt(u * u + 2 * acceleration * g);
    const double s = u < 0 ? 2 * g / (root - u) : acceleration > 0 ? (u + root) / acceleration : 1e300;
    least = std::min(least, s);
  }
  (void)side;
  return least;
}

}  // namespace

void forEachCorner(const Shape& shape, const std::function<void(const Vec3&)>& f) {
  if (const auto* box = std::get_if<BoxShape>(&shape)) {
    for (int i = 0; i < 8; ++i) f(cornerOf(*box, i));
  } else if (const auto* mesh = std::get_if<MeshShape>(&shape)) {
    for (const Vec3& v : mesh->tree.corners()) f(v);
  }
}

Gap polyhedraGap(const Shape& a, const Pose& X_WA, const Shape& b, const Pose& X_WB, double limit) {
  const auto *boxA = std::get_if<BoxShape>(&a), *boxB = std::get_if<BoxShape>(&b);
  if (boxA && boxB) return boxGap(*boxA, X_WA, *boxB, X_WB);
  if (boxA) return boxOnMesh(*boxA, X_WA, std::get<MeshShape>(b), X_WB, limit);
  if (boxB) {
    Gap g = boxOnMesh(*boxB, X_WB, std::get<MeshShape>(a), X_WA, limit);
    g.point += g.distance * g.normal, g.normal = -g.normal;
    return g;
  }
  return meshGap(std::get<MeshShape>(a), X_WA, std::get<MeshShape>(b), X_WB);
}

std::optional<Touch> polyhedraTouch(const Side& a, const Side& b, double from, double to,
                                    std::uint64_t& iterations) {
  const auto *boxA = std::get_if<BoxShape>(a.shape), *boxB = std::get_if<BoxShape>(b.shape);
  const MotionBound ma = a.boundOver(from, to), mb = b.boundOver(from, to);
  const auto reachOf = [](const Side& s) {
    return s.body ? s.body->reach : s.bound().centre.norm() + s.bound().radius;
  };
  const double ra = reachOf(a), rb = reachOf(b);
  const double acceleration = std::max(ma.accelerationAt(ra), mb.accelerationAt(rb));
  double tau = from;
  std::optional<Touch> lastFree;
  for (int i = 0; i < kMostLooks; ++i) {
    ++iterations;
    const Kinematics ka = a.at(tau), kb = b.at(tau);
    const Gap g = polyhedraGap(*a.shape, ka.pose, *b.shape, kb.pose, 1e300);
    if (!std::isfinite(g.distance) || !g.normal.allFinite()) return lastFree;  // unknown: the last free pose
    const double rate = g.normal.dot(ka.velocityAt(g.point) - kb.velocityAt(g.point));
    const bool overlap = g.distance <= 0;
    if (g.distance <= kNear && rate < 0) return Touch{tau, g, false};
    if (!overlap) lastFree = Touch{tau, g, false};
    // Speed of the points of the two towards each other, seen along no particular direction.
    const Vec3 relative = ka.v - kb.v;
    const double speed = relative.norm() + ka.omega.norm() * ra + kb.omega.norm() * rb +
                         (ma.accelerationAt(ra) + mb.accelerationAt(rb)) * 0.5 * (to - tau);
    if (!(speed > 0)) return {};
    double step = std::max(g.distance, kLeast) / speed;
    if (boxA && boxB && g.distance > kNear) {
      const Vec3 middle = g.point + 0.5 * g.distance * g.normal,
                 v = 0.5 * (ka.velocityAt(g.point) + kb.velocityAt(g.point));
      step = std::max(step, std::min(safeStep(a, ka, *boxA, g.normal, middle, v, acceleration),
                                     safeStep(b, kb, *boxB, -g.normal, middle, v, acceleration)));
    }
    tau += std::max(step, 1e-9);
    if (!(tau <= to)) return {};
  }
  if (!lastFree) return {};
  const Kinematics ka = a.at(lastFree->tau), kb = b.at(lastFree->tau);
  const bool closing =
      lastFree->gap.normal.dot(ka.velocityAt(lastFree->gap.point) - kb.velocityAt(lastFree->gap.point)) < 0;
  return closing ? lastFree : std::nullopt;
}

}  // namespace stadion
