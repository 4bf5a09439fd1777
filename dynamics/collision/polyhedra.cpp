#include "dynamics/collision/polyhedra.h"

#include "dynamics/collision/mesh_manifold.h"
#include "dynamics/collision/mesh_pairs.h"
#include "dynamics/collision/touch.h"
#include "dynamics/collision/triangle_distance.h"

#include <algorithm>
#include <cmath>

namespace stadion {
namespace {

constexpr double kNear = 1e-6;  ///< meshes closer than this touch [m]
/// Motion between two looks at a pair that touches and parts [m]: less than kNear, so that it cannot get
/// past.
constexpr double kLeast = 5e-7;
constexpr double kShare = 0.9;  ///< steps believe this much of a gap: it is found much sooner
constexpr int kMostFaceLooks = 100;

Gap gapOf(const NearestPoints& n, const Triangle& b) {
  if (n.distance > 0) return {n.distance, n.b, (n.a - n.b) / n.distance, false, -1};
  return {0, n.b, b.normal, false, -1};
}

/// Two triangles, one of each mesh.
struct Pair {
  std::uint32_t a = 0, b = 0;
};

/// A pair nearer than `limit`, in the frame of b: none is nearer than `share` of its distance. `pair` is a
/// guess, and what was found.
Gap nearestWithin(const TriangleTree& a, const TriangleTree& b, const Pose& X_BA, double limit, double share,
                  Pair& pair) {
  NearestPoints best;
  best.distance = limit;
  bool any = false;
  const auto look = [&](std::uint32_t i, std::uint32_t j, const Triangle& t) {
    const NearestPoints n = nearestOfTriangles(t, b.triangles()[j]);
    if (n.distance < best.distance) {
      best = n;
      pair = {i, j};
      any = true;
    }
  };
  // Between faces that lie flat on each other very many pairs are about as near.
  const auto reach = [&] { return any ? share * best.distance : limit; };
  look(pair.a, pair.b, moved(a.triangles()[pair.a], X_BA));
  // Meshes that cross are near enough.
  MeshPairs(a, b, X_BA)
      .each([&] { return best.distance > 0 ? reach() : std::numeric_limits<double>::quiet_NaN(); }, look);
  if (!any) return {};
  Gap g = gapOf(best, b.triangles()[pair.b]);
  g.triangle = static_cast<std::int32_t>(pair.b);
  return g;
}

Gap inWorld(Gap g, const Pose& X) {
  g.point = X * g.point;
  g.normal = X.q * g.normal;
  return g;
}

/// How long points that come at `speed`, and no faster than `acceleration` allows, need for `distance` at
/// least.
double leastTime(double distance, double speed, double acceleration) {
  return 2 * distance / (speed + std::sqrt(speed * speed + 2 * acceleration * distance));
}

/// Where the meshes, in touch, move towards each other fastest; nothing if they part everywhere.
std::optional<Gap> closingPoint(const TriangleTree& a, const Kinematics& ka, const TriangleTree& b,
                                const Kinematics& kb, const Gap& nearest) {
  std::vector<ManifoldPoint> points;
  meshesManifold(a, ka.pose, ka.p, b, kb.pose, kb.p, kNear, points);
  if (points.empty()) points.push_back({nearest, 0, Carrier::None});
  std::optional<Gap> found;
  double fastest = 0;
  for (const ManifoldPoint& p : points) {
    const double rate = p.gap.normal.dot(ka.velocityAt(p.gap.point) - kb.velocityAt(p.gap.point));
    if (rate < fastest) {
      fastest = rate;
      found = p.gap;
    }
  }
  return found;
}

}  // namespace

Gap meshesGapWithin(const TriangleTree& a, const Pose& X_WA, const TriangleTree& b, const Pose& X_WB,
                    double limit) {
  Pair pair;
  return inWorld(nearestWithin(a, b, X_WB.inverse() * X_WA, limit, 1, pair), X_WB);
}

Gap meshesGap(const MeshShape& a, const Pose& X_WA, const MeshShape& b, const Pose& X_WB) {
  const auto pair = MeshHierarchy::nearest(*a.hierarchy, X_WA, *b.hierarchy, X_WB);
  if (!pair) return {0, X_WB * b.tree.bounds().centre(), (X_WA.p - X_WB.p).normalized(), false, -1};
  const Pose X = X_WB.inverse() * X_WA;
  const Triangle& face = b.tree.triangles()[pair->b];
  Gap g = gapOf(nearestOfTriangles(moved(a.tree.triangles()[pair->a], X), face), face);
  if (pair->crossing) g.distance = std::min(g.distance, 0.0);
  g.triangle = static_cast<std::int32_t>(pair->b);
  return inWorld(g, X_WB);
}

std::optional<Touch> meshesTouch(const Side& a, const Side& b, double from, double to,
                                 std::uint64_t& iterations) {
  const MotionBound ma = a.boundOver(from, to), mb = b.boundOver(from, to);
  const auto reachOf = [](const Side& s) {
    return s.body ? s.body->reach : s.bound().centre.norm() + s.bound().radius;
  };
  const double ra = reachOf(a), rb = reachOf(b), acceleration = ma.accelerationAt(ra) + mb.accelerationAt(rb);
  TriangleTree sheet;
  const TriangleTree *meshA = trianglesOf(*a.shape, sheet), *meshB = trianglesOf(*b.shape, sheet);
  if (!meshA || !meshB) return {};
  double tau = from;
  std::optional<Touch> lastFree;
  Pair pair;
  for (int i = 0; i < kMostFaceLooks; ++i) {
    ++iterations;
    const Kinematics ka = a.at(tau), kb = b.at(tau);
    // Speed of the points of the two towards each other, seen along no particular direction.
    const double speed = (ka.v - kb.v).norm() + ka.omega.norm() * ra + kb.omega.norm() * rb, left = to - tau;
    if (!(speed + acceleration > 0)) return {};
    const double reach = (speed + 0.5 * acceleration * left) * left + kNear;
    const double apart = (ka.pose * a.bound().centre - kb.pose * b.bound().centre).norm() - a.bound().radius -
                         b.bound().radius;
    if (apart > reach) return {};
    const Pose X = kb.pose.inverse() * ka.pose;
    if (!X.finite()) return lastFree;  // unknown: the last free pose
    const Gap g = inWorld(nearestWithin(*meshA, *meshB, X, reach, kShare, pair), kb.pose);
    if (!(g.distance < reach)) return {};
    if (g.distance <= kNear)
      if (const auto closing = closingPoint(*meshA, ka, *meshB, kb, g)) return Touch{tau, *closing, false};
    if (g.distance > 0) lastFree = Touch{tau, g, false};
    tau += std::max(leastTime(g.distance > kNear ? kShare * g.distance : kLeast, speed, acceleration), 1e-9);
    if (!(tau <= to)) return {};
  }
  // Too near for too long to see farther. Nothing is lost if they meet here, even as they part. A pair that
  // does so again and again is in lasting contact.
  return lastFree;
}

}  // namespace stadion
