#include "dynamics/collision/box_manifold.h"

#include "dynamics/collision/triangle_distance.h"

#include <cmath>

namespace stadion {
namespace {

constexpr double kFavourFaces = 1e-5;  ///< an edge pair must separate better than any face by this [m]
constexpr double kSquare = 1e-6;       ///< sine of the angle by which a normal may miss that of two edges

struct ClippedVertex {
  Vec3 p;
  std::uint32_t key;
};

int closestAxis(const Pose& X, const Vec3& n) {
  int i = 0;
  (X.q.conjugate() * n).cwiseAbs().maxCoeff(&i);
  return i;
}

/// The face of a box whose outward normal is nearest to n, in order round it.
std::vector<ClippedVertex> faceTowards(const Pose& X, const Vec3& half, const Vec3& n) {
  const Vec3 l = X.q.conjugate() * n;
  int k = 0;
  l.cwiseAbs().maxCoeff(&k);
  const int u = (k + 1) % 3, v = (k + 2) % 3;
  std::vector<ClippedVertex> face;
  for (const auto& [su, sv] : {std::pair(-1, -1), std::pair(1, -1), std::pair(1, 1), std::pair(-1, 1)}) {
    Vec3 c;
    c[k] = l[k] < 0 ? -half[k] : half[k];
    c[u] = su * half[u];
    c[v] = sv * half[v];
    face.push_back({X * c, static_cast<std::uint32_t>(face.size())});
  }
  return face;
}

/// Sutherland and Hodgman: what of the polygon has n . p <= d.
void clip(std::vector<ClippedVertex>& polygon, const Vec3& n, double d, std::uint32_t side) {
  std::vector<ClippedVertex> out;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const ClippedVertex &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const double ha = n.dot(a.p) - d, hb = n.dot(b.p) - d;
    if (ha <= 0) out.push_back(a);
    if ((ha < 0 && hb > 0) || (ha > 0 && hb < 0))
      out.push_back({a.p + (b.p - a.p) * (ha / (ha - hb)), 16 + 8 * side + a.key % 8});
  }
  polygon = std::move(out);
}

void faceContact(const Pose& R, const Vec3& halfR, const Pose& I, const Vec3& halfI, const Vec3& out,
                 double margin, bool referenceIsB, std::vector<ManifoldPoint>& points) {
  const int k = closestAxis(R, out);
  Vec3 n = R.q * Vec3::Unit(k);
  if (n.dot(out) < 0) n = -n;
  std::vector<ClippedVertex> polygon = faceTowards(I, halfI, -n);
  std::uint32_t side = 0;
  for (const int axis : {(k + 1) % 3, (k + 2) % 3}) {
    const Vec3 across = R.q * Vec3::Unit(axis);
    clip(polygon, across, across.dot(R.p) + halfR[axis], ++side);
    clip(polygon, -across, -across.dot(R.p) + halfR[axis], ++side);
  }
  const double level = n.dot(R.p) + halfR[k];
  for (const ClippedVertex& x : polygon) {
    const double gap = n.dot(x.p) - level;
    if (gap > margin) continue;
    const Vec3 onB = referenceIsB ? Vec3(x.p - gap * n) : x.p;
    points.push_back({{gap, onB, referenceIsB ? n : Vec3(-n), true, -1},
                      (referenceIsB ? 0u : 500u) + x.key,
                      referenceIsB ? Carrier::A : Carrier::B});
  }
}

}  // namespace

double separatingAxis(const Pose& A, const Vec3& halfA, const Pose& B, const Vec3& halfB, Vec3& axis,
                      bool& edges) {
  const Mat3 RA = A.q.toRotationMatrix(), RB = B.q.toRotationMatrix();
  const Vec3 d = A.p - B.p;
  double best = -1e300;
  const auto attempt = [&](const Vec3& n, bool edgePair) {
    const double s = std::fabs(n.dot(d)) - (RA.transpose() * n).cwiseAbs().dot(halfA) -
                     (RB.transpose() * n).cwiseAbs().dot(halfB);
    if (s > best + (edgePair ? kFavourFaces : 1e-9)) {
      best = s;
      axis = n.dot(d) < 0 ? Vec3(-n) : n;
      edges = edgePair;
    }
  };
  for (int i = 0; i < 3; ++i) attempt(RB.col(i), false);
  for (int i = 0; i < 3; ++i) attempt(RA.col(i), false);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      const Vec3 n = RA.col(i).cross(RB.col(j));
      if (n.squaredNorm() > 1e-6) attempt(n.normalized(), true);
    }
  return best;
}

void boxManifold(const Pose& A, const Vec3& halfA, const Pose& B, const Vec3& halfB, double margin,
                 std::vector<ManifoldPoint>& points) {
  Vec3 n = Vec3::UnitZ();
  bool edges = false;
  if (separatingAxis(A, halfA, B, halfB, n, edges) > margin) return;
  if (!edges) {
    const double ofA = (A.q.conjugate() * n).cwiseAbs().maxCoeff(),
                 ofB = (B.q.conjugate() * n).cwiseAbs().maxCoeff();
    if (ofB >= ofA - 1e-9) {
      faceContact(B, halfB, A, halfA, n, margin, true, points);
    } else {
      faceContact(A, halfA, B, halfB, -n, margin, false, points);
    }
    if (!points.empty()) return;
  }
  // The edges that reach farthest towards each other along n, and are square to it: of bodies deep in each
  // other, others may be nearer. Of edges that reach equally far, the one beside the other box.
  const auto supportingEdge = [](const Pose& X, const Vec3& half, const Vec3& along, const Vec3& other,
                                 int axis, Vec3& p, Vec3& d) {
    const Vec3 l = X.q.conjugate() * along, beside = X.inverse() * other;
    Vec3 c;
    for (int i = 0; i < 3; ++i)
      c[i] = (std::fabs(l[i]) > kSquare ? l[i] : beside[i]) < 0 ? -half[i] : half[i];
    c[axis] = -half[axis];
    p = X * c;
    d = X.q * Vec3(2 * half[axis] * Vec3::Unit(axis));
  };
  NearestPoints best;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      Vec3 p, d, q, e;
      supportingEdge(A, halfA, -n, B.p, i, p, d);
      supportingEdge(B, halfB, n, A.p, j, q, e);
      const Vec3 across = d.cross(e);
      if (across.squaredNorm() < 1e-6 * d.squaredNorm() * e.squaredNorm()) continue;
      if (across.cross(n).squaredNorm() > kSquare * kSquare * across.squaredNorm()) continue;
      const NearestPoints x = nearestOfSegments(p, d, q, e);
      if (x.distance < best.distance) best = x;
    }
  if (best.distance > 1e299) return;
  const double gap = n.dot(best.a - best.b);
  if (!edges && (best.a - best.b - gap * n).norm() > kSquare) return;  // they pass each other
  if (gap < margin) points.push_back({{gap, best.b, n, false, -1}, 999});
}

}  // namespace stadion
