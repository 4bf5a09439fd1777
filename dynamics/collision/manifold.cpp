#include "dynamics/collision/manifold.h"

#include "dynamics/collision/box_manifold.h"
#include "dynamics/collision/convex_manifold.h"
#include "dynamics/collision/mesh_manifold.h"
#include "dynamics/collision/polyhedra.h"

#include <algorithm>
#include <cmath>

namespace stadion {
namespace {

constexpr std::size_t kMostManifoldPairs = 16;
constexpr double kOnFace = 1e-6;  ///< a centre this near to a face is inside [m]
constexpr std::size_t kMostDeep = 4;
constexpr double kSameWay = 0.7;  ///< cosine of directions that lead out at the same side

void flipGap(Gap& g) {
  g.point += g.distance * g.normal;
  g.normal = -g.normal;
}

/// Of points that lead the same way only the first.
void keepDistinct(std::vector<ManifoldPoint>& points, std::size_t most) {
  std::vector<ManifoldPoint> kept;
  for (const ManifoldPoint& p : points) {
    const bool known = std::ranges::any_of(
        kept, [&](const ManifoldPoint& k) { return k.gap.normal.dot(p.gap.normal) > kSameWay; });
    if (!known && kept.size() < most) kept.push_back(p);
  }
  points = std::move(kept);
}

/// Ways out for a ball whose centre is inside a closed mesh: the faces that it sees from behind, nearest
/// first, one for each direction. None if the centre is outside.
void waysOut(const Vec3& c, double r, const TriangleTree& tree, const std::vector<std::uint32_t>& near,
             const Pose& X, std::vector<ManifoldPoint>& points) {
  double nearest = 1e300;
  bool inside = false;
  for (const std::uint32_t i : near) {
    const Triangle& t = tree.triangles()[i];
    const double away = (c - closestPoint(t, c).point).norm(), height = t.normal.dot(c - t.v[0]);
    if (away > nearest + 1e-9) continue;
    inside = height <= kOnFace && (inside || away < nearest - 1e-9);
    nearest = std::min(nearest, away);
  }
  if (!inside) return;
  for (const std::uint32_t i : near) {
    const Triangle& t = tree.triangles()[i];
    const ClosestPoint q = closestPoint(t, c);
    const double away = (c - q.point).norm();
    if (q.edge >= 0 || !(t.normal.dot(c - t.v[0]) <= kOnFace) || away > r) continue;
    points.push_back({{std::min(t.normal.dot(c - q.point), 0.0) - r, X * q.point, X.q * t.normal, true,
                       static_cast<std::int32_t>(i)},
                      i + 1});
  }
  std::ranges::stable_sort(points, std::greater{}, [](const ManifoldPoint& p) { return p.gap.distance; });
  keepDistinct(points, kMostManifoldPairs);
}

/// A ball touches a mesh wherever a face, a ridge or a peak is near enough; merged edges do not count.
void ballOnMesh(const Vec3& centre, double r, const MeshShape& mesh, const Pose& X, double margin,
                std::vector<ManifoldPoint>& points) {
  const Vec3 c = X.inverse() * centre;
  Aabb box;
  box.include(c);
  box.lo.array() -= r + margin;
  box.hi.array() += r + margin;
  std::vector<std::uint32_t> near;
  mesh.tree.overlapping(box, near);
  if (mesh.tree.closed()) waysOut(c, r, mesh.tree, near, X, points);
  if (!points.empty()) return;
  for (const bool edges : {false, true}) {
    for (const std::uint32_t i : near) {
      const Triangle& t = mesh.tree.triangles()[i];
      const ClosestPoint q = closestPoint(t, c);
      if ((q.edge >= 0) != edges) continue;
      const double height = t.normal.dot(c - t.v[0]), away = (c - q.point).norm();
      if (height < 0 && mesh.tree.closed()) continue;  // the far side of what it is outside of
      if (away - r > margin) continue;
      if (edges && !q.corner && t.merged[static_cast<std::size_t>(q.edge)]) continue;
      const Vec3 n = away > 0 ? Vec3((c - q.point) / away) : t.normal;
      const bool known = std::any_of(points.begin(), points.end(), [&](const ManifoldPoint& p) {
        return p.gap.normal.dot(X.q * n) > 1 - 1e-6;
      });
      if (known || points.size() >= kMostManifoldPairs) continue;
      points.push_back({{away - r, X * q.point, X.q * n, !edges, static_cast<std::int32_t>(i)}, i + 1});
    }
  }
  const auto deepest = std::ranges::min_element(points, {}, [](const auto& p) { return p.gap.distance; });
  if (deepest != points.end() && deepest->gap.distance < -kDeepBall * r) {
    std::ranges::stable_sort(points, {}, [](const ManifoldPoint& p) { return p.gap.distance; });
    keepDistinct(points, kMostDeep);
  }
}

/// Where corners of a come near the surface of b.
void cornersNear(const Side& a, const Side& b, double tau, double margin, bool flipped, std::uint32_t keyBase,
                 std::vector<ManifoldPoint>& points) {
  const Kinematics ka = a.at(tau), kb = b.at(tau);
  std::uint32_t key = keyBase;
  std::vector<ManifoldPoint> found;
  const auto forEachCorner = [](const Shape& shape, auto f) {
    if (const auto* box = std::get_if<BoxShape>(&shape)) {
      for (int i = 0; i < 8; ++i)
        f(box->pose * Vec3((i & 1 ? 1 : -1) * box->half.x(), (i & 2 ? 1 : -1) * box->half.y(),
                           (i & 4 ? 1 : -1) * box->half.z()));
    } else if (const auto* mesh = std::get_if<MeshShape>(&shape)) {
      for (const Vec3& v : mesh->tree.corners()) f(v);
    }
  };
  forEachCorner(*a.shape, [&](const Vec3& corner) {
    ++key;
    const Vec3 x = ka.pose * corner;
    Gap g = ballGap(x, 0, *b.shape, kb.pose, {margin});
    if (!(g.distance < margin)) return;
    // A corner of a flat thing lies beside another's edge as well as above its face: only faces carry
    // corners.
    if (!g.face && std::holds_alternative<BoxShape>(*b.shape)) return;
    if (flipped) flipGap(g);
    found.push_back({g, key, flipped ? Carrier::B : Carrier::A});
  });
  if (found.size() > kMostManifoldPairs) {  // keep the deepest and the widest spread
    std::stable_sort(found.begin(), found.end(),
                     [](const auto& l, const auto& r) { return l.gap.distance < r.gap.distance; });
    std::vector<ManifoldPoint> kept{found.front()};
    while (kept.size() < kMostManifoldPairs) {
      std::size_t best = 0;
      double far = -1;
      for (std::size_t i = 0; i < found.size(); ++i) {
        double d = 1e300;
        for (const ManifoldPoint& k : kept) d = std::min(d, (k.gap.point - found[i].gap.point).squaredNorm());
        if (d > far) {
          far = d;
          best = i;
        }
      }
      kept.push_back(found[best]);
    }
    found = std::move(kept);
  }
  points.insert(points.end(), found.begin(), found.end());
}

bool isBallSide(const Side& s) {
  return std::holds_alternative<BallShape>(*s.shape);
}
bool isPlaneSide(const Side& s) {
  return std::holds_alternative<PlaneShape>(*s.shape);
}

void ballPoints(const Side& ball, const Side& other, double tau, double margin,
                std::vector<ManifoldPoint>& points) {
  const auto& s = std::get<BallShape>(*ball.shape);
  const Vec3 c = ball.at(tau).pose * s.centre;
  const Pose X = other.at(tau).pose;
  if (const auto* mesh = std::get_if<MeshShape>(other.shape)) {
    ballOnMesh(c, s.radius, *mesh, X, margin, points);
    return;
  }
  const Gap g = ballGap(c, s.radius, *other.shape, X, {margin});
  if (g.distance < margin) points.push_back({g, 1});
}

/// Where the two are nearest, as at a corner beside an edge.
void addNearest(const Side& a, const Side& b, double tau, double margin, std::vector<ManifoldPoint>& points) {
  const Gap nearest = gapBetween(a, b, tau, {margin});
  if (nearest.distance < margin) points.push_back({nearest, 99});
}

/// Meshes, and bounded planes against them.
bool triangleManifold(const Side& a, const Side& b, double tau, double margin,
                      std::vector<ManifoldPoint>& points) {
  if (!std::holds_alternative<MeshShape>(*a.shape) && !std::holds_alternative<MeshShape>(*b.shape))
    return false;
  TriangleTree sheet;
  const TriangleTree *ta = trianglesOf(*a.shape, sheet), *tb = trianglesOf(*b.shape, sheet);
  if (!ta || !tb) return false;
  const Kinematics ka = a.at(tau), kb = b.at(tau);
  const bool near = meshesManifold(*ta, ka.pose, ka.p, *tb, kb.pose, kb.p, margin, points);
  if (!near || !points.empty()) return true;
  const Gap nearest = meshesGapWithin(*ta, ka.pose, *tb, kb.pose, margin);
  if (nearest.distance < margin) points.push_back({nearest, 99});
  return true;
}

}  // namespace

void manifold(const Side& a, const Side& b, double tau, double margin, std::vector<ManifoldPoint>& points) {
  points.clear();
  if (isBallSide(a)) {
    ballPoints(a, b, tau, margin, points);
  } else if (isBallSide(b)) {
    ballPoints(b, a, tau, margin, points);
    for (ManifoldPoint& p : points) flipGap(p.gap);
  } else if (const auto* boxA = std::get_if<BoxShape>(a.shape), *boxB = std::get_if<BoxShape>(b.shape);
             boxA && boxB) {
    boxManifold(a.at(tau).pose * boxA->pose, boxA->half, b.at(tau).pose * boxB->pose, boxB->half, margin,
                points);
    if (points.empty() && (a.collider || b.collider)) addNearest(a, b, tau, margin, points);
  } else if (triangleManifold(a, b, tau, margin, points) || solidManifold(a, b, tau, margin, points)) {
    return;
  } else {
    if (!isPlaneSide(a)) cornersNear(a, b, tau, margin, false, 1000, points);
    if (!isPlaneSide(b)) cornersNear(b, a, tau, margin, true, 1000000, points);
    if (isPlaneSide(a) || isPlaneSide(b)) return;
    if (points.empty()) addNearest(a, b, tau, margin, points);
  }
}

}  // namespace stadion
