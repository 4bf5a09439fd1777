#include "dynamics/collision/convex_gap.h"

#include <algorithm>
#include <cmath>

namespace stadion {
namespace {

constexpr double kNearGap = 1e-5;  ///< cores closer than this have their normal from their features [m]
constexpr double kFavour = 1e-11;  ///< faces and edges are preferred to what was only searched by this [m]
constexpr double kHold = 1e-4;     ///< distance to hold off for a first look [m]
constexpr double kLeastHold = 1e-7;
constexpr int kMostTurns = 12;
constexpr double kShallow = 1e-6;  ///< overlap that a face may have found alone [m]
constexpr double kGrazing = 1e-9;  ///< overlap up to which nothing but that face can be meant [m]
constexpr double kOver = 1e-10;    ///< beside a face by this still counts as over it [m]

struct Best {
  const ConvexCore &a, &b;
  double gap = -1e300;
  Vec3 n = Vec3::UnitZ();

  void attempt(const Vec3& direction, const Vec3& guess, double handicap = 0) {
    const double side = direction.dot(guess);
    const Vec3 d = side < 0 ? Vec3(-direction) : direction;
    const double g = separationAlong(d, a, b);
    if (g - handicap > gap) {
      gap = g;
      n = d;
    }
    if (std::fabs(side) > 0.02) return;
    const double h = separationAlong(-d, a, b);
    if (h - handicap > gap) {
      gap = h;
      n = -d;
    }
  }
};

/// The points where the bodies touch, given a direction between them and points nearby.
void putOn(ConvexGap& g, const ConvexCore& a, const ConvexCore& b, const Vec3& nearA, const Vec3& nearB) {
  const Vec3& n = g.normal;
  g.onA = nearA - n * (n.dot(nearA) + a.extent(-n));
  g.onB = nearB + n * (b.extent(n) - n.dot(nearB));
}

/// About the way out of an overlap, and points nearby.
Vec3 overlapDirection(const ConvexCore& a, const ConvexCore& b, const Vec3& guess, Vec3& nearA, Vec3& nearB) {
  const double most = a.thickness() + b.thickness();
  for (double depth = 1e-4; depth < 8 * most; depth *= 8) {
    const CoreDistance thin = coreDistance(a.eroded(depth), b.eroded(depth), guess, 1e-6);
    if (!thin.apart) continue;
    nearA = thin.a;
    nearB = thin.b;
    return thin.normal;
  }
  Vec3 n = a.middle() - b.middle();
  const double l = n.norm();
  n = l > 0 ? Vec3(n / l) : Vec3::UnitZ();
  nearA = nearB = 0.5 * (a.support(-n) + b.support(n));
  return n;
}

/// The usual case, proven at once: the point of one that reaches farthest along a face's normal of the other
/// lies over that face.
bool onFace(const ConvexCore& a, const ConvexCore& b, const Vec3& towards, Vec3& nearA, Vec3& nearB,
            Best& best) {
  const Directions da = directionsNear(a, -towards, nearA), db = directionsNear(b, towards, nearB);
  Best face{a, b};
  for (int i = 0; i < db.faceCount; ++i) face.attempt(db.faces[static_cast<std::size_t>(i)], towards);
  const double ofB = face.gap;
  for (int i = 0; i < da.faceCount; ++i) face.attempt(da.faces[static_cast<std::size_t>(i)], towards, 1e-13);
  if (!(face.gap > -kShallow) || face.n.dot(towards) < 0.5) return false;
  const Vec3& n = face.n;
  if (face.gap == ofB) {
    const Vec3 x = a.support(-n) - (a.radius + face.gap) * n;
    if (!b.holds(x - b.radius * n, kOver)) return false;
    nearB = x;
  } else {
    const Vec3 x = b.support(n) + b.radius * n;
    if (!a.holds(x + (face.gap + a.radius) * n, kOver)) return false;
    nearB = x;
  }
  nearA = nearB;
  best.gap = face.gap;
  best.n = face.n;
  return true;
}

/// The plane of a face of b, of those towards a's middle, that the middle is farthest outside of; false if
/// b has none there.
bool facePlane(const ConvexCore& b, const Vec3& middle, Vec3& n, double& level) {
  const Vec3 l = b.R.transpose() * (middle - b.p);
  switch (b.kind) {
  case ConvexCore::Kind::Box: {
    int k = 0;
    (l.cwiseAbs() - b.half).maxCoeff(&k);
    n = l[k] < 0 ? Vec3(-b.R.col(k)) : Vec3(b.R.col(k));
    level = n.dot(b.p) + b.half[k];
    return true;
  }
  case ConvexCore::Kind::Cylinder: {
    const double r = l.head<2>().norm() - b.half.x();
    if (r > 0 && r > std::fabs(l.z()) - b.half.z()) return false;
    n = l.z() < 0 ? Vec3(-b.R.col(2)) : Vec3(b.R.col(2));
    level = n.dot(b.p) + b.half.z();
    return true;
  }
  case ConvexCore::Kind::Hull: {
    if (b.shrink != 1) return false;
    double most = -1e300;
    const ConvexShape::Face* best = nullptr;
    b.hull->eachFaceTowards(l - b.hull->centre, [&](std::uint32_t i) {
      const ConvexShape::Face& f = b.hull->faces[i];
      if (const double h = f.normal.dot(l) - f.offset; h > most) {
        most = h;
        best = &f;
      }
    });
    if (!best) return false;
    n = b.R * best->normal;
    level = n.dot(b.p) + best->offset;
    return true;
  }
  case ConvexCore::Kind::Triangle:
    n = b.normal.dot(middle - b.v[0]) < 0 ? Vec3(-b.normal) : b.normal;
    level = n.dot(b.v[0]);
    return true;
  case ConvexCore::Kind::Point:
  case ConvexCore::Kind::Segment: return false;
  }
  return false;
}

/// A rim over an edge: the best direction square to the edge, where the line between the supports is square
/// to the next ones. The slope there falls through zero.
void acrossEdge(Best& best, const Vec3& edge) {
  const Vec3 square = best.n - edge * edge.dot(best.n);
  const double l = square.norm();
  if (!(l > 0.5)) return;
  const Vec3 n0 = square / l, u = edge.cross(n0);
  const auto along = [&](double t) { return Vec3((n0 + t * u) / std::sqrt(1 + t * t)); };
  const auto slope = [&](double t) {
    const Vec3 n = along(t);
    return edge.cross(n).dot(best.a.support(-n) - best.b.support(n));
  };
  double lo = -0.02, hi = 0.02, atLo = slope(lo), atHi = slope(hi);
  if (!(atLo > 0 && atHi < 0)) return;
  double t = 0;
  int side = 0;
  for (int i = 0; i < 40 && hi - lo > 1e-15; ++i) {  // false position after Illinois
    const double last = t;
    t = (lo * atHi - hi * atLo) / (atHi - atLo);
    const double s = slope(t);
    if (std::fabs(t - last) < 1e-16 || s == 0) break;
    if (s > 0) {
      lo = t;
      atLo = s;
      if (side > 0) atHi *= 0.5;
      side = 1;
    } else {
      hi = t;
      atHi = s;
      if (side < 0) atLo *= 0.5;
      side = -1;
    }
  }
  best.attempt(along(t), best.n);
}

/// The widest gap near a direction, and points nearby.
void search(Best& best, const Vec3& towards, Vec3& nearA, Vec3& nearB) {
  const ConvexCore &a = best.a, &b = best.b;
  best.attempt(towards, towards, kFavour);
  // Held off along the normal; the more precise it is, the more precise the next.
  // Close to, edges that cross at a small angle count for what they are.
  double hold = kHold;
  for (int i = 0; i < kMostTurns; ++i, hold = std::max(0.1 * hold, kLeastHold)) {
    const double off = std::max(hold, 4 * (std::fabs(best.gap) + a.radius + b.radius));
    const CoreDistance held = coreDistance(a.moved(off * best.n), b, best.n);
    if (!held.apart) break;
    const double before = best.gap;
    best.attempt(held.normal, held.normal, 1e-15);
    nearA = held.a - off * best.n;
    nearB = held.b;
    if (!(best.gap > before) && hold <= kLeastHold) break;
  }
  const Vec3 n = best.n;
  const Directions da = directionsNear(a, -n, nearA), db = directionsNear(b, n, nearB);
  for (int i = 0; i < db.faceCount; ++i) best.attempt(db.faces[static_cast<std::size_t>(i)], n);
  for (int i = 0; i < da.faceCount; ++i) best.attempt(da.faces[static_cast<std::size_t>(i)], n, 1e-13);
  for (int i = 0; i < da.edgeCount; ++i)
    for (int j = 0; j < db.edgeCount; ++j) {
      const Vec3 e = da.edges[static_cast<std::size_t>(i)].cross(db.edges[static_cast<std::size_t>(j)]);
      const double s = e.norm();
      if (s > 1e-4) best.attempt(e / s, n, 1e-13);
    }
  if (a.kind == ConvexCore::Kind::Cylinder)
    for (int j = 0; j < db.edgeCount; ++j) acrossEdge(best, db.edges[static_cast<std::size_t>(j)]);
  if (b.kind == ConvexCore::Kind::Cylinder)
    for (int i = 0; i < da.edgeCount; ++i) acrossEdge(best, da.edges[static_cast<std::size_t>(i)]);
}

}  // namespace

bool gapOverFace(const ConvexCore& a, const ConvexCore& b, double beside, ConvexGap& g) {
  Vec3 n;
  double level;
  if (!facePlane(b, a.middle(), n, level)) return false;
  const Vec3 x = a.support(-n) - a.radius * n;
  const double gap = n.dot(x) - level - b.radius;
  if (!(gap > -kGrazing)) return false;
  if (!(gap > beside) && !b.holds(x - (gap + b.radius) * n, kOver)) return false;
  g.distance = gap;
  g.normal = n;
  g.onA = x;
  g.onB = x - gap * n;
  return true;
}

double separationAlong(const Vec3& n, const ConvexCore& a, const ConvexCore& b) {
  return -a.extent(-n) - b.extent(n);
}

ConvexGap convexGap(const ConvexCore& a, const ConvexCore& b, const Vec3& guess, double accuracy) {
  ConvexGap easy;
  if (gapOverFace(a, b, 1e300, easy)) return easy;
  if (gapOverFace(b, a, 1e300, easy)) {
    easy.normal = -easy.normal;
    std::swap(easy.onA, easy.onB);
    return easy;
  }
  const CoreDistance d = coreDistance(a, b, guess, accuracy);
  ConvexGap g;
  if (d.apart && d.distance > kNearGap) {
    // What the supports say is certain; the distance found may be too long where the search ended in
    // rounding.
    const double sure = separationAlong(d.normal, a, b);
    const double rounding = a.radius + b.radius;
    if (accuracy > 1e-15 && rounding > 0 &&
        sure < rounding)  // the accuracy of the cores is not that of the gap
      return convexGap(a, b, d.normal, 1e-15);
    g.distance = sure;
    g.normal = d.normal;
    g.onA = d.a - a.radius * d.normal;
    g.onB = d.b + b.radius * d.normal;
    if (sure + rounding >= d.distance * (1 - 1e-6 - 2 * accuracy)) return g;
  }
  Vec3 nearA = d.a, nearB = d.b;
  const Vec3 towards = d.apart && d.distance > 1e-9 ? d.normal : overlapDirection(a, b, guess, nearA, nearB);
  Best best{a, b};
  if (onFace(a, b, towards, nearA, nearB, best)) {
    g.distance = best.gap;
    g.normal = best.n;
    g.onA = g.onB = nearB;
    g.onA += g.distance * g.normal;
    return g;
  }
  search(best, towards, nearA, nearB);
  g.distance = separationAlong(best.n, a, b);
  g.normal = best.n;
  putOn(g, a, b, nearA, nearB);
  return g;
}

}  // namespace stadion
