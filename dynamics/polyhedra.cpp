#include "dynamics/polyhedra.h"

#include "dynamics/touch.h"
#include "dynamics/triangle_distance.h"

#include <algorithm>
#include <cmath>

namespace stadion {
namespace {

constexpr double kNear = 1e-6;   ///< meshes closer than this touch [m]
constexpr double kLeast = 1e-5;  ///< least motion between two looks at a pair that parts [m]
constexpr int kMostLooks = 400;

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

}  // namespace

Gap meshesGap(const MeshShape& a, const Pose& X_WA, const MeshShape& b, const Pose& X_WB) {
  const auto pair = MeshHierarchy::nearest(*a.hierarchy, X_WA, *b.hierarchy, X_WB);
  if (!pair) return {0, X_WB * b.tree.bounds().centre(), (X_WA.p - X_WB.p).normalized(), false, -1};
  const Pose X = X_WB.inverse() * X_WA;
  Gap g = gapOf(moved(a.tree.triangles()[pair->a], X), b.tree.triangles()[pair->b]);
  if (pair->crossing) g.distance = std::min(g.distance, 0.0);
  g.point = X_WB * g.point, g.normal = X_WB.q * g.normal;
  g.triangle = static_cast<std::int32_t>(pair->b);
  return g;
}

std::optional<Touch> meshesTouch(const Side& a, const Side& b, double from, double to,
                                 std::uint64_t& iterations) {
  const MotionBound ma = a.boundOver(from, to), mb = b.boundOver(from, to);
  const auto reachOf = [](const Side& s) {
    return s.body ? s.body->reach : s.bound().centre.norm() + s.bound().radius;
  };
  const double ra = reachOf(a), rb = reachOf(b);
  double tau = from;
  std::optional<Touch> lastFree;
  for (int i = 0; i < kMostLooks; ++i) {
    ++iterations;
    const Kinematics ka = a.at(tau), kb = b.at(tau);
    const Gap g = meshesGap(std::get<MeshShape>(*a.shape), ka.pose, std::get<MeshShape>(*b.shape), kb.pose);
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
    const double step = std::max(g.distance, kLeast) / speed;
    tau += std::max(step, 1e-9);
    if (!(tau <= to)) return {};
  }
  // Too near for too long to see farther: nothing gets lost if they meet here, even as they part. Whoever
  // does so again and again is in lasting contact.
  return lastFree;
}

}  // namespace stadion
