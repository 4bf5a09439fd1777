#include "dynamics/flight/bias.h"

#include "engine/maths/functions.h"

#include <cmath>

namespace stadion {
namespace {

/// Rotation by a share of the angle from a to b, about what is square to both; about `spare` where they are
/// opposite.
Quat shareOfTurn(const Vec3& a, const Vec3& b, const Vec3& spare, double share) {
  const Vec3 r = a.cross(b);
  const double sine = r.norm(), cosine = a.dot(b), angle = det::atan2(sine, cosine);
  if (sine > 1e-12 * std::fabs(cosine)) return det::expRotation(share * angle / sine * r);
  return cosine < 0 ? det::expRotation(share * angle * spare) : Quat::Identity();
}

Quat along(const Quat& q, const Vec3& v, double share) {
  return (shareOfTurn(q * Vec3::UnitX(), v, q * Vec3::UnitY(), share) * q).normalized();
}

Quat covariant(const Bias& bias, const Quat& q, const Vec3& v, double speed, double seconds) {
  const Vec3 u = q.conjugate() * v / speed;
  Vec3 to;
  for (int i = 0; i < 3; ++i) to[i] = u[i] * det::exp((bias.spread[i] - 1) * bias.rate * speed * seconds);
  // Across the axis that attracts, and nothing else: it stays.
  if (!(to.norm() > 1e-12)) return q;
  return (q * shareOfTurn(to, u, Vec3::UnitY(), 1)).normalized();
}

}  // namespace

Bias biasFor(const FlightShape& shape, BiasForm form, double rate) {
  if (shape.round()) return {form, 0, Vec3::Ones()};
  return {form, rate, shape.axes.variance / shape.axes.variance.x()};
}

double biasRate(double share, double hz) {
  return -hz * det::log(1 - share);
}

Quat biased(const Bias& bias, const Quat& q_WA, const Vec3& v, double seconds) {
  const double speed = v.norm();
  if (bias.rate == 0 || !(speed > 1e-9) || !std::isfinite(speed)) return q_WA;
  switch (bias.form) {
  case BiasForm::Paper: return along(q_WA, v / speed, bias.rate);
  case BiasForm::Covariance: return covariant(bias, q_WA, v, speed, seconds);
  case BiasForm::Flow: break;
  }
  constexpr double kFading = 0.1;  // at this speed it has half its effect [m/s]
  const double fade = speed * speed / (speed * speed + kFading * kFading);
  return along(q_WA, v / speed, -det::expm1(-bias.rate * fade * seconds));
}

}  // namespace stadion
