#include "dynamics/collision/touch_seams.h"

#include "dynamics/collision/manifold.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace stadion {
namespace {

constexpr double kAlike = 1 - 1e-6;  ///< cosine of the normals of faces that count as one
constexpr double kOpposed = -0.99;   ///< cosine below which two surfaces squeeze the body
constexpr double kSteep = 0.5;       ///< cosine below which a contact stands across the surface
constexpr double kAlong = 2e-3;      ///< how far the surface is followed [m]
constexpr double kInPlane = 0.1;     ///< share of a way by which it may leave a plane
constexpr double kOnRise = 1e-2;     ///< a slope is straight so far from its foot [m]
constexpr double kLeastRise = 1e-2;  ///< sine of the least angle between a slope and the surface before it
constexpr double kOwn = 1e-9;        ///< sine of the angle between normals that are the same
constexpr double kStraight = 1e-3;   ///< sine of the angle between two ways along one surface
constexpr double kOnePlace = 1e-6;   ///< points that are nearer to each other count once [m]

/// The point of the solid that is nearest to x.
Vec3 nearestTo(const Vec3& x, const Shape& shape, const Pose& X, double limit, double& distance) {
  const Gap g = ballGap(x, 0, shape, X, {limit});
  distance = g.distance;
  return g.distance > 0 ? g.point : x;
}

/// Returns true if contacts with one such shape may hide each other. A sheet has edges and corners in its surface,
/// as a mesh has.
bool isOfTriangles(const Shape& shape) {
  return std::holds_alternative<MeshShape>(shape) || std::holds_alternative<PlaneShape>(shape);
}

/// Whether the piece goes on along the contact's plane to above the surface.
bool risesAbove(const Gap& gap, const Shape& piece, const Pose& X, const Vec3& m, double height) {
  const Vec3& n = gap.normal;
  const Vec3 up = (m - n * n.dot(m)).normalized();
  for (const double way : {1e-3, 1e-2, 1e-1}) {
    double away = 0;
    const Vec3 foot = nearestTo(gap.point + way * up, piece, X, 1.01 * way, away);
    if (!(away < 1e299)) continue;
    const Vec3 d = foot - gap.point;
    if (height + m.dot(d) > kFlush && std::fabs(n.dot(d)) <= kInPlane * d.norm()) return true;
  }
  return false;
}

/// Whether the surface goes on, from below the contact, on the side that its normal leans to.
bool goesOn(const Gap& gap, const Bearing& on, double height, const std::vector<Bearing>& others) {
  const Vec3 &n = gap.normal, &m = on.gap.normal;
  const Vec3 lean = n - m * n.dot(m), way = kAlong * lean.normalized(), x = gap.point - height * m + way;
  const auto liesOn = [&](const Bearing& p) {
    double away = 0;
    const Vec3 foot = nearestTo(x, *p.shape, p.X_WN, 2 * kFlush, away);
    return away <= kFlush && n.dot(foot - gap.point) > 0.5 * n.dot(way);
  };
  return liesOn(on) || std::ranges::any_of(others, liesOn);
}

}  // namespace

bool isHidden(const Bearing& own, const Bearing& on, const std::vector<Bearing>& others) {
  const Gap& gap = own.gap;
  const Vec3 &n = gap.normal, &m = on.gap.normal;
  const double cosine = n.dot(m);
  if ((gap.face && cosine > kAlike) || cosine < kOpposed) return false;
  const double height = m.dot(gap.point - on.gap.point);
  if (height > kFlush || height < -kFlush - std::max(0.0, -on.gap.distance)) return false;
  if (!(n.cross(m).norm() > kOwn)) return false;
  return !risesAbove(gap, *own.shape, own.X_WN, m, height) &&
         (cosine < kSteep || goesOn(gap, on, height, others));
}

namespace {

/// The same as normalOfRise() for a place on the piece, looked for in the direction `up` from there.
std::optional<Vec3> slopeTowards(const Vec3& up, const Vec3& foot, const Vec3& m, const Shape& piece,
                                 const Pose& X) {
  const double reach = up.norm();
  const auto surfaceOver = [&](double way) {  // from the foot, to what is nearest to a place over it
    double away = 0;
    return Vec3(nearestTo(foot + way * up, piece, X, 1.01 * way * reach, away) - foot);
  };
  const Vec3 far = surfaceOver(kOnRise);
  if (!(far.norm() > kLeastRise * kOnRise) || !(m.dot(far) > kLeastRise * far.norm())) return {};
  // It rises straight from the foot. The upper edge of a flush piece is at one height instead.
  const Vec3 near = surfaceOver(0.5 * kOnRise), normal = kOnRise * up - far;
  if ((2 * near - far).norm() > kStraight * far.norm() || !(normal.norm() > kLeastRise * kOnRise)) return {};
  return normal.normalized();
}

}  // namespace

std::optional<Vec3> normalOfSlope(const Shape& piece, const Pose& X, const Vec3& foot, const Vec3& m,
                                  const Vec3& side) {
  // A piece that stands upright or leans over is behind what is straight over its foot.
  for (const Vec3& up : {m, Vec3(m + side)})
    if (const auto normal = slopeTowards(up, foot, m, piece, X); normal && normal->dot(side) > 0)
      return normal;
  return {};
}

std::optional<Vec3> normalOfRise(const Bearing& own, const Bearing& on) {
  const Vec3 &n = own.gap.normal, &m = on.gap.normal, along = n - m * n.dot(m);
  const double size = along.norm();
  const Vec3 side = size > kOwn ? Vec3(along / size) : n;
  const auto normal = normalOfSlope(*own.shape, own.X_WN, own.gap.point, m, side);
  return normal && normal->dot(n) > 0 ? normal : std::nullopt;
}

bool isInSurface(const Bearing& own, const Bearing& on) {
  const Vec3& m = on.gap.normal;
  return !own.gap.face && own.gap.normal.dot(m) > kAlike &&
         std::fabs(m.dot(own.gap.point - on.gap.point)) <= kFlush + std::max(0.0, -on.gap.distance);
}

bool isSquareToPiece(const Bearing& on) {
  constexpr double kOnIt = 0.01 * kAlong;  // [m]
  const double diagonal = std::sqrt(0.5);
  const Vec3 u = on.gap.normal.unitOrthogonal(), v = on.gap.normal.cross(u);
  const auto liesOn = [&](double x, double y) {
    double away = 0;
    nearestTo(on.gap.point + kAlong * (x * u + y * v), *on.shape, on.X_WN, 2 * kAlong, away);
    return away <= kOnIt;
  };
  // Along an edge the piece lies in the plane of contact, but not on both sides of an angle.
  const std::array<bool, 8> lies{
      liesOn(1, 0),  liesOn(diagonal, diagonal),   liesOn(0, 1),  liesOn(-diagonal, diagonal),
      liesOn(-1, 0), liesOn(-diagonal, -diagonal), liesOn(0, -1), liesOn(diagonal, -diagonal)};
  for (std::size_t i = 0; i < lies.size(); ++i)
    if (lies[i] && lies[(i + 1) % lies.size()]) return true;
  return false;
}

namespace {

/// Returns true if the body touches both, at one place.
bool areAtOnePlace(const Bearing& a, const Bearing& b) {
  return b.gap.distance <= kTouching && (a.gap.point - b.gap.point).norm() <= kFlush;
}

/// The same for two pieces; `up` is about the direction out of their surface.
std::optional<Vec3> normalOver(const Bearing& a, const Bearing& b, const Vec3& up) {
  const Vec3 &n = a.gap.normal, &m = b.gap.normal, apart = n - m;
  // Each leans away from its own piece. From above, a little way on, each piece's surface is looked for.
  const Vec3 lean = kAlong * (apart - up * up.dot(apart)).normalized();
  const auto surfaceOf = [&](const Bearing& p, const Vec3& way) {
    double away = 0;
    return nearestTo(p.gap.point + way + kAlong * up, *p.shape, p.X_WN, 4 * kAlong, away);
  };
  const auto follows = [](const Vec3& from, const Vec3& to, const Vec3& way) {
    return way.dot(to - from) > 0.5 * way.squaredNorm();
  };
  const Vec3 onA = surfaceOf(a, -lean), onB = surfaceOf(b, lean);
  if (!follows(a.gap.point, onA, -lean) || !follows(b.gap.point, onB, lean)) return {};
  // They make up one surface only if both go on straight from one to the other.
  const Vec3 across = onB - onA;
  const auto isStraight = [&](const Vec3& way) {
    return way.cross(across).norm() < kStraight * way.norm() * across.norm();
  };
  if (!isStraight(onA - surfaceOf(a, -2 * lean)) || !isStraight(surfaceOf(b, 2 * lean) - onB)) return {};
  const Vec3 along = kAlong * across.cross(up).normalized();
  Vec3 normal = up - across * (across.dot(up) / across.squaredNorm());
  for (const Vec3& way : {along, Vec3(-along)})
    if (const Vec3 beside = surfaceOf(a, way - lean); follows(onA, beside, way)) {
      normal = across.cross(beside - onA);
      break;
    }
  normal *= (normal.dot(up) < 0 ? -1 : 1) / normal.norm();
  if (std::fabs(normal.dot(a.gap.point - onA)) > kFlush || std::fabs(normal.dot(b.gap.point - onB)) > kFlush)
    return {};
  if (n.cross(normal).norm() < kOwn || m.cross(normal).norm() < kOwn) return {};
  return normal;
}

}  // namespace

std::optional<Vec3> normalOverSlit(const Bearing& a, const std::vector<Bearing>& others) {
  Vec3 up = a.gap.normal;
  for (const Bearing& on : others)
    if (areAtOnePlace(a, on)) up += on.gap.normal;
  if (!(up.norm() > 1e-3)) return {};
  up.normalize();
  const auto faces = [&](const Vec3& normal) {  // all that touch there
    return std::ranges::all_of(
        others, [&](const Bearing& on) { return !areAtOnePlace(a, on) || on.gap.normal.dot(normal) > 0; });
  };
  // The piece across is the one with the normal that differs most.
  std::optional<Vec3> found;
  double least = 1;
  for (const Bearing& on : others) {
    const double cosine = a.gap.normal.dot(on.gap.normal);
    if (!areAtOnePlace(a, on) || !(cosine < least) || cosine < kOpposed) continue;
    if (a.gap.normal.cross(on.gap.normal).norm() < kOwn) continue;
    if (a.of == on.of && !isOfTriangles(*a.shape)) continue;
    if (const auto normal = normalOver(a, on, up); normal && faces(*normal)) found = normal, least = cosine;
  }
  return found;
}

namespace {

/// Gives points at a slit the normal of the surface there. Marks all but one of those at one place as gone.
/// Returns true if there are any.
bool joinOverSlits(std::vector<Bearing>& points, std::vector<char>& gone) {
  std::vector<Bearing> left;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (!gone[i]) left.push_back(points[i]);
  std::vector<std::size_t> turned;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (gone[i] || points[i].gap.distance > kTouching) continue;
    if (const auto normal = normalOverSlit(points[i], left)) {
      points[i].gap.normal = *normal;
      turned.push_back(i);
    }
  }
  for (std::size_t k = 0; k < turned.size(); ++k)
    for (std::size_t l = 0; l < k; ++l) {
      const Gap &p = points[turned[k]].gap, &kept = points[turned[l]].gap;
      if (!gone[turned[l]] && (p.point - kept.point).norm() < kOnePlace && p.normal.dot(kept.normal) > kAlike)
        gone[turned[k]] = 1;
    }
  return !turned.empty();
}

}  // namespace

std::vector<char> hiddenAmong(std::vector<Bearing>& points) {
  const std::size_t n = points.size();
  const auto differs = [&](const Bearing& p) {
    return p.of != points[0].of || p.gap.normal.dot(points[0].gap.normal) < 1 - 1e-12;
  };
  if (n < 2 || std::ranges::none_of(points, differs)) return {};
  std::vector<char> hidden(n, 0), gone(n, 0);
  std::vector<std::pair<std::size_t, std::size_t>> hides;  // which bearing, which other
  std::vector<std::pair<std::size_t, Vec3>> rises;         // which bearing, the normal of its slope
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t k = 0; k < n; ++k) {
      const Bearing &p = points[i], &on = points[k];
      if (i == k || on.gap.distance > kTouching) continue;
      if (p.of == on.of && !isOfTriangles(*p.shape)) continue;
      const bool isBehind = isHidden(p, on, points);
      if (!isBehind && !isInSurface(p, on)) continue;
      if (const auto normal = normalOfRise(p, on)) {
        if (rises.empty() || rises.back().first != i) rises.emplace_back(i, *normal);
      } else if (isBehind) {
        hides.emplace_back(k, i);
        hidden[i] = 1;
      }
    }
  for (const auto& [by, hiddenOne] : hides)
    if (!hidden[by]) gone[hiddenOne] = 1;
  for (const auto& [i, normal] : rises) {
    Gap& gap = points[i].gap;
    if (gone[i]) continue;
    gap.distance *= normal.dot(gap.normal);
    gap.normal = normal;
  }
  if (!joinOverSlits(points, gone) && hides.empty() && rises.empty()) return {};
  return gone;
}

}  // namespace stadion
