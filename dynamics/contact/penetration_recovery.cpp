#include "dynamics/contact/penetration_recovery.h"

#include "dynamics/collision/convex_gap.h"
#include "dynamics/collision/manifold.h"
#include "dynamics/collision/mesh_manifold.h"
#include "dynamics/contact/contact_solver.h"

#include <algorithm>
#include <cmath>

namespace stadion {
namespace {

constexpr double kOut = 2e-5;      ///< overlap of what rests on something [m]
constexpr double kUpright = 0.05;  ///< cosine: steeper faces do not bar the body's return

bool isMesh(const Shape& s) {
  return std::holds_alternative<MeshShape>(s);
}

/// The faces of what is bounded by planes, built into `made` if it is no mesh; null for all that is round.
const TriangleTree* facesOf(const Shape& shape, TriangleTree& made) {
  std::vector<std::array<Vec3, 3>> faces;
  if (const auto* box = std::get_if<BoxShape>(&shape)) {
    for (int k = 0; k < 3; ++k)
      for (const double side : {-1.0, 1.0}) {
        const auto corner = [&](double u, double v) {
          Vec3 x;
          x[k] = side;
          x[(k + 1) % 3] = u;
          x[(k + 2) % 3] = side * v;
          return box->pose * box->half.cwiseProduct(x);
        };
        const std::array<Vec3, 4> c{corner(-1, -1), corner(1, -1), corner(1, 1), corner(-1, 1)};
        faces.push_back({c[0], c[1], c[2]});
        faces.push_back({c[0], c[2], c[3]});
      }
  } else if (const auto* hull = std::get_if<ConvexShape>(&shape)) {
    for (const ConvexShape::Face& f : hull->faces)
      for (std::uint32_t k = 2; k < f.count; ++k)
        faces.push_back({hull->points[hull->loops[f.first]], hull->points[hull->loops[f.first + k - 1]],
                         hull->points[hull->loops[f.first + k]]});
  } else {
    return trianglesOf(shape, made);
  }
  made = TriangleTree(faces);
  return &made;
}

/// Where the segment from p to q crosses the triangle, as a share of its length; negative if it does not.
double crossing(const Triangle& t, const Vec3& p, const Vec3& q) {
  const double hp = t.normal.dot(p - t.v[0]), hq = t.normal.dot(q - t.v[0]);
  if ((hp > 0) == (hq > 0)) return -1;
  const double share = hp / (hp - hq);
  const Vec3 x = p + share * (q - p);
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 e = t.v[(i + 1) % 3] - t.v[i];
    if (t.normal.cross(e).dot(x - t.v[i]) < -1e-9 * e.norm()) return -1;
  }
  return share;
}

/// The first triangle that the segment from p to q crosses; -1 if none.
std::int32_t firstCrossed(const TriangleTree& tree, const Vec3& p, const Vec3& q) {
  Aabb box;
  box.include(p);
  box.include(q);
  std::int32_t first = -1;
  double least = 2;
  tree.eachOverlapping(box, [&](std::uint32_t i) {
    const double share = crossing(tree.triangles()[i], p, q);
    if (share >= 0 && share < least) {
      least = share;
      first = static_cast<std::int32_t>(i);
    }
  });
  return first;
}

/// A body in the collider's frame.
struct Inside {
  const Shape& shape;
  Pose X;       ///< of the body
  Vec3 middle;  ///< of its bounding sphere
  ConvexCore core;
  Aabb box;

  Inside(const Side& body, const Side& collider, double tau)
      : shape(*body.shape), X(collider.at(tau).pose.inverse() * body.at(tau).pose),
        middle(X * body.bound().centre) {
    if (!isMesh(shape)) coreOf(shape, X, core);
    for (int i = 0; i < 3; ++i) {
      box.hi[i] = extent(Vec3::Unit(i));
      box.lo[i] = -extent(-Vec3::Unit(i));
    }
  }
  /// How far the body reaches along d.
  double extent(const Vec3& d) const {
    if (!isMesh(shape)) return core.extent(d);
    const Vec3 local = X.q.conjugate() * d;
    double most = -1e300;
    for (const Vec3& c : std::get<MeshShape>(shape).tree.corners()) most = std::max(most, local.dot(c));
    return most + d.dot(X.p);
  }
  /// For a mesh always true: its exact test costs too much here.
  bool overlaps(const Triangle& t) const {
    return isMesh(shape) || convexGap(core, coreOf(t, Pose{}), middle - t.v[0]).distance < 0;
  }
};

/// Among the faces that the body overlaps and its middle has not crossed, the one whose normal is nearest to d.
std::optional<PenetrationRecovery> mostAlong(const Inside& body, const TriangleTree& tree, const Vec3& d) {
  std::optional<PenetrationRecovery> best;
  tree.eachOverlapping(body.box, [&](std::uint32_t i) {
    const Triangle& t = tree.triangles()[i];
    const double side = t.normal.dot(body.middle - t.v[0]) < 0 ? -1 : 1;
    if ((side < 0 && tree.closed()) || !body.overlaps(t)) return;
    const Vec3 n = side * t.normal;
    if (!best || n.dot(d) > best->normal.dot(d) + 1e-12) best = PenetrationRecovery{0, n, side};
  });
  return best;
}

}  // namespace

bool wentInto(const Side& collider, double tau, const Vec3& from, const Vec3& to) {
  Aabb path;
  path.include(from);
  path.include(to);
  if (!boundingBox(*collider.shape, collider.at(tau).pose).overlaps(path)) return false;
  TriangleTree sheet;
  const TriangleTree* tree = facesOf(*collider.shape, sheet);
  if (!tree) return false;
  const Pose X = collider.at(tau).pose.inverse();
  const std::int32_t first = firstCrossed(*tree, X * from, X * to);
  if (first < 0) return false;
  const Triangle& t = tree->triangles()[static_cast<std::size_t>(first)];
  return std::fabs(t.normal.dot(X * to - t.v[0])) < kDeepest;
}

bool overlaps(const Side& body, const Side& collider, double tau) {
  const double gap = gapBetween(body, collider, tau, {0.01}).distance;
  return isMesh(*body.shape) && isMesh(*collider.shape) ? gap <= 0 : gap < -kTouching;
}

std::optional<PenetrationRecovery> penetrationRecoveryOf(const Side& body, const Side& collider, double tau,
                                                         const Vec3& free) {
  TriangleTree sheet;
  const TriangleTree* tree = facesOf(*collider.shape, sheet);
  if (!tree) return {};
  const Inside inside(body, collider, tau);
  const Vec3 from = collider.at(tau).pose.inverse() * free, back = from - inside.middle;
  std::optional<PenetrationRecovery> recovery;
  if (const std::int32_t first = firstCrossed(*tree, from, inside.middle); first >= 0) {
    const Triangle& t = tree->triangles()[static_cast<std::size_t>(first)];
    if (!(std::fabs(t.normal.dot(inside.middle - t.v[0])) < kDeepest)) return {};
    const double side = t.normal.dot(back) < 0 ? -1 : 1;
    recovery = PenetrationRecovery{0, side * t.normal, side};
  } else if (overlaps(body, collider, tau)) {
    recovery = mostAlong(inside, *tree, back.normalized());
  }
  if (!recovery) return {};
  recovery->of = collider.key.id;
  if (!barrier(body, collider, tau, *recovery)) return {};
  return recovery;
}

std::optional<PlaneShape> barrier(const Side& body, const Side& collider, double tau,
                                  const PenetrationRecovery& recovery) {
  TriangleTree sheet;
  const TriangleTree* tree = facesOf(*collider.shape, sheet);
  if (!tree) return {};
  const Inside inside(body, collider, tau);
  const Vec3& n = recovery.normal;
  const auto bars = [&](const Triangle& t) { return recovery.side * t.normal.dot(n) > kUpright; };
  double top = 0, level = -1e300;
  for (int i = 0; i < 3; ++i) top += n[i] * (n[i] < 0 ? inside.box.lo[i] : inside.box.hi[i]);
  tree->eachOverlapping(inside.box, [&](std::uint32_t i) {
    const Triangle& t = tree->triangles()[i];
    if (!bars(t)) return;
    const double high = std::max({n.dot(t.v[0]), n.dot(t.v[1]), n.dot(t.v[2])});
    level = std::max(level, std::min(high, top));
  });
  bool below = false;
  // What leans over as it comes out sinks in by its own length at most.
  const Vec3 far = inside.middle + (kDeepest + 2 * body.bound().radius) * n;
  if (const std::int32_t above = firstCrossed(*tree, inside.middle, far); above >= 0) {
    const Triangle& t = tree->triangles()[static_cast<std::size_t>(above)];
    below = bars(t);
    if (below)
      level = std::max(level, n.dot(inside.middle + crossing(t, inside.middle, far) * (far - inside.middle)));
  }
  if (!(level + inside.extent(-n) > kOut)) return {};
  if (!below) {
    const double gap = gapBetween(body, collider, tau, {0.01}).distance;
    if (gap > (isMesh(*body.shape) && isMesh(*collider.shape) ? 1e-6 : -kOut)) return {};
  }
  const Pose X = collider.at(tau).pose;
  Mat3 axes = basisAround(X.q * n);
  axes.col(0).swap(axes.col(2));
  axes.col(0) = axes.col(1).cross(axes.col(2));
  return PlaneShape{{X * (level * n), Quat(axes)}};
}

}  // namespace stadion
