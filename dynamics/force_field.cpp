#include "dynamics/force_field.h"

#include "engine/maths/functions.h"

namespace stadion {
namespace {

double divisor(LinearField::Unit unit, double mass) {
  return unit == LinearField::Unit::Force ? mass : 1;
}

Vec3 pushOf(const LinearField& f, const Pose& X_WF, const Vec3&, double mass) {
  return X_WF.q * f.push / divisor(f.unit, mass);
}

Vec3 pushOf(const SphericalField& f, const Pose& X_WF, const Vec3& p, double mass) {
  const Vec3 d = p - X_WF.p;
  const double r = d.norm();
  if (!(r < f.radius) || r < 1e-12) return Vec3::Zero();
  const double left = 1 - r / f.radius;
  double share = 1;
  if (f.falloff == SphericalField::Falloff::Linear) share = left;
  if (f.falloff == SphericalField::Falloff::Square) share = left * left;
  return d * (f.strength * share / (r * divisor(f.unit, mass)));
}

}  // namespace

bool ForceField::uniform() const {
  return std::holds_alternative<LinearField>(law) && start.q.coeffs() == end.q.coeffs();
}

Vec3 accelerationOf(const ForceField& field, const Vec3& p, const Vec3& v, double mass, double s) {
  (void)v;  // no law of today depends on it
  const Pose X_WF = field.moving() ? det::interpolate(field.start, field.end, s) : field.end;
  return std::visit([&](const auto& law) { return pushOf(law, X_WF, p, mass); }, field.law);
}

}  // namespace stadion
