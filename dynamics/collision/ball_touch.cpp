#include "dynamics/collision/ball_touch.h"

#include "dynamics/maths/first_root.h"

#include <cmath>

namespace stadion {
namespace {

double radiusOf(const Side& s) {
  return s.body ? s.body->radius() : std::get<BallShape>(*s.shape).radius;
}
Vec3 centreOf(const Side& s, double tau) {
  return s.body ? s.body->position(tau) : s.collider->motion.end * std::get<BallShape>(*s.shape).centre;
}
Vec3 velocityOf(const Side& s, double tau) {
  return s.body ? s.body->velocity(tau) : Vec3(Vec3::Zero());
}
/// Half the acceleration of a parabola.
Vec3 halfPull(const Side& s) {
  return s.body ? s.body->path.c[2] : Vec3(Vec3::Zero());
}

/// The gap of two centres that are d apart.
Gap gapOf(const Side& b, const Vec3& d, double reach, double tau) {
  const double distance = d.norm();
  const Vec3 n = distance > 0 ? Vec3(d / distance) : Vec3(Vec3::UnitZ());
  return {distance - reach, centreOf(b, tau) + radiusOf(b) * n, n, false, -1};
}

/// Seconds until d + u t is as short as `reach`, at most `most`; infinity if it does not become so.
double straightApproach(const Vec3& d, const Vec3& u, double reach, double tolerance, double most) {
  constexpr double never = std::numeric_limits<double>::infinity();
  const double closing = -d.dot(u);
  if (!(closing > 0)) return never;
  const double over = d.squaredNorm() - reach * reach;
  if (over <= 2 * reach * tolerance) return 0;
  if (over > 2 * closing * most) return never;
  // u^2 R^2 - (u^2 d^2 - (u.d)^2), without the cancellation
  const double square = u.squaredNorm() * reach * reach - d.cross(u).squaredNorm();
  if (!(square >= 0)) return never;
  const double t = over / (closing + std::sqrt(square));
  return t <= most ? t : never;
}

}  // namespace

Gap ballsGap(const Side& a, const Side& b, double tau) {
  return gapOf(b, centreOf(a, tau) - centreOf(b, tau), radiusOf(a) + radiusOf(b), tau);
}

std::optional<Touch> ballsTouch(const Side& a, const Side& b, double from, double to, std::uint64_t& count) {
  const double reach = radiusOf(a) + radiusOf(b);
  const Vec3 c0 = centreOf(a, from), d = c0 - centreOf(b, from);
  const Vec3 u = velocityOf(a, from) - velocityOf(b, from);
  const double tolerance = touchTolerance(c0);
  const bool parabolas = (!a.body || a.body->path.isParabola()) && (!b.body || b.body->path.isParabola());
  const Vec3 half = parabolas ? Vec3(halfPull(a) - halfPull(b)) : Vec3(Vec3::Zero());
  if (parabolas && half.isZero(0)) {
    ++count;
    const double t = straightApproach(d, u, reach, tolerance, to - from);
    if (!(from + t <= to)) return {};
    return Touch{from + t, gapOf(b, d + t * u, reach, from + t), false};
  }
  const auto bound = [](const Side& s) { return s.body ? s.body->path.accelerationBound() : 0; };
  const auto probe = [&](double tau) {
    const double t = tau - from;
    const Vec3 at = parabolas ? Vec3(d + t * (u + t * half)) : Vec3(centreOf(a, tau) - centreOf(b, tau));
    const Vec3 rate = parabolas ? Vec3(u + 2 * t * half) : Vec3(velocityOf(a, tau) - velocityOf(b, tau));
    const double distance = at.norm();
    const Vec3 n = distance > 0 ? Vec3(at / distance) : Vec3(Vec3::UnitZ());
    return Probe{distance - reach, n.dot(rate)};
  };
  const double most = parabolas ? 2 * half.norm() : bound(a) + bound(b);
  const auto tau = firstRoot(probe, from, to, most, tolerance, count);
  if (!tau) return {};
  return Touch{*tau, ballsGap(a, b, *tau), false};
}

}  // namespace stadion
