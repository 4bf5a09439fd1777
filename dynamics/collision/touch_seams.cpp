#include "dynamics/collision/touch_seams.h"

#include "dynamics/collision/manifold.h"

#include <algorithm>
#include <cmath>

namespace stadion {
namespace {

constexpr double kAlike = 1 - 1e-6;  ///< cosine of the normals of faces that count as one
constexpr double kOpposed = -0.99;   ///< cosine below which two surfaces squeeze the body
constexpr double kSteep = 0.5;       ///< cosine below which a contact stands across the surface
constexpr double kAlong = 2e-3;      ///< how far the surface is followed [m]
constexpr double kInPlane = 0.1;     ///< share of a way by which it may leave a plane

/// The point of the solid that is nearest to x.
Vec3 nearestTo(const Vec3& x, const Shape& shape, const Pose& X, double limit, double& distance) {
  const Gap g = ballGap(x, 0, shape, X, {limit});
  distance = g.distance;
  return g.distance > 0 ? g.point : x;
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
bool goesOn(const Gap& gap, const Bearing& on, double height) {
  const Vec3 &n = gap.normal, &m = on.gap.normal;
  const Vec3 lean = n - m * n.dot(m), way = kAlong * lean.normalized();
  double away = 0;
  const Vec3 foot = nearestTo(gap.point - height * m + way, *on.shape, on.X_WN, 2 * kFlush, away);
  return away <= kFlush && n.dot(foot - gap.point) > 0.5 * n.dot(way);
}

}  // namespace

bool isHidden(const Gap& gap, const Shape& piece, const Pose& X, const Bearing& on) {
  const Vec3 &n = gap.normal, &m = on.gap.normal;
  const double cosine = n.dot(m);
  if ((gap.face && cosine > kAlike) || cosine < kOpposed) return false;
  const double height = m.dot(gap.point - on.gap.point);
  if (height > kFlush || height < -kFlush - std::max(0.0, -on.gap.distance)) return false;
  if (!(n.cross(m).norm() > 1e-9)) return false;
  return !risesAbove(gap, piece, X, m, height) && (cosine < kSteep || goesOn(gap, on, height));
}

std::vector<char> hiddenAmong(const std::vector<Bearing>& points) {
  const std::size_t n = points.size();
  const auto differs = [&](const Bearing& p) {
    return p.of != points[0].of || p.gap.normal.dot(points[0].gap.normal) < 1 - 1e-12;
  };
  if (n < 2 || std::ranges::none_of(points, differs)) return {};
  std::vector<char> hidden(n, 0);
  std::vector<std::pair<std::size_t, std::size_t>> hides;  // which bearing, which other
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t k = 0; k < n; ++k) {
      const Bearing &p = points[i], &on = points[k];
      if (i == k || on.gap.distance > kTouching) continue;
      if (p.of == on.of && !std::holds_alternative<MeshShape>(*p.shape)) continue;
      if (isHidden(p.gap, *p.shape, p.X_WN, on)) {
        hides.emplace_back(k, i);
        hidden[i] = 1;
      }
    }
  if (hides.empty()) return {};
  std::vector<char> gone(n, 0);
  for (const auto& [by, hiddenOne] : hides)
    if (!hidden[by]) gone[hiddenOne] = 1;
  return gone;
}

}  // namespace stadion
