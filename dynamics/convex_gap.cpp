#include "dynamics/convex_gap.h"

#include <algorithm>
#include <cmath>

namespace stadion {
namespace {

constexpr double kNear = 1e-5;     ///< cores closer than this have their normal from their features [m]
constexpr double kFavour = 1e-11;  ///< faces are preferred to edges by this [m]

struct Best {
  const ConvexCore &a, &b;
  double gap = -1e300;
  Vec3 n = Vec3::UnitZ();

  void attempt(const Vec3& direction, const Vec3& guess, double handicap = 0) {
    const double side = direction.dot(guess);
    const Vec3 d = side < 0 ? Vec3(-direction) : direction;
    const double g = separationAlong(d, a, b);
    if (g - handicap > gap) gap = g, n = d;
    if (std::fabs(side) > 0.02) return;
    const double h = separationAlong(-d, a, b);
    if (h - handicap > gap) gap = h, n = -d;
  }
};

/// The points where the bodies touch, given a direction between them and points nearby.
void putOn(ConvexGap& g, const ConvexCore& a, const ConvexCore& b, const Vec3& nearA, const Vec3& nearB) {
  const Vec3& n = g.normal;
  g.onA = nearA - n * (n.dot(nearA) + a.extent(-n));
  g.onB = nearB + n * (b.extent(n) - n.dot(nearB));
}

}  // namespace

double separationAlong(const Vec3& n, const ConvexCore& a, const ConvexCore& b) {
  return -a.extent(-n) - b.extent(n);
}

ConvexGap convexGap(const ConvexCore& a, const ConvexCore& b, const Vec3& guess) {
  const CoreDistance d = coreDistance(a, b, guess);
  ConvexGap g;
  if (d.apart && d.distance > kNear) {
    // What the supports say is certain; the distance found may be too long where the search ended in
    // rounding.
    const double sure = separationAlong(d.normal, a, b);
    g.distance = sure, g.normal = d.normal;
    g.onA = d.a - a.radius * d.normal, g.onB = d.b + b.radius * d.normal;
    if (sure + a.radius + b.radius >= d.distance * (1 - 1e-6)) return g;
  }
  Vec3 towards = d.normal, nearA = d.a, nearB = d.b;
  Best best{a, b};
  if (!d.apart || d.distance < 1e-9) {
    // Thinner by and by, until they part.
    const double most = a.thickness() + b.thickness();
    CoreDistance thin;
    for (double depth = 1e-4; depth < 8 * most; depth *= 8) {
      // A round one alone at first: then the direction is exact where it meets a corner.
      const bool roundA = a.kind == ConvexCore::Kind::Cylinder;
      thin = roundA ? coreDistance(a.eroded(depth), b, guess) : coreDistance(a, b.eroded(depth), guess);
      if (thin.apart) break;
      thin = coreDistance(a.eroded(depth), b.eroded(depth), guess);
      if (thin.apart) break;
    }
    if (thin.apart) {
      towards = thin.normal, nearA = thin.a, nearB = thin.b;
    } else {
      towards = a.middle() - b.middle();
      const double n = towards.norm();
      towards = n > 0 ? Vec3(towards / n) : Vec3::UnitZ();
      nearA = nearB = 0.5 * (a.support(-towards) + b.support(towards));
    }
  }
  const Directions da = directionsNear(a, -towards, nearA), db = directionsNear(b, towards, nearB);
  for (int i = 0; i < db.faceCount; ++i) best.attempt(db.faces[static_cast<std::size_t>(i)], towards);
  for (int i = 0; i < da.faceCount; ++i) best.attempt(da.faces[static_cast<std::size_t>(i)], towards, 1e-13);
  best.attempt(towards, towards, kFavour);
  for (int i = 0; i < da.edgeCount; ++i)
    for (int j = 0; j < db.edgeCount; ++j) {
      const Vec3 n = da.edges[static_cast<std::size_t>(i)].cross(db.edges[static_cast<std::size_t>(j)]);
      const double s = n.norm();
      if (s > 1e-4) best.attempt(n / s, towards, kFavour);
    }
  g.distance = best.gap, g.normal = best.n;
  putOn(g, a, b, nearA, nearB);
  return g;
}

}  // namespace stadion
