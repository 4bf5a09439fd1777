#include "dynamics/motion/force_field.h"

#include "engine/maths/functions.h"

#include <cmath>
#include <limits>

namespace stadion {
namespace {

double divisor(LinearField::Unit unit, double mass) {
  return unit == LinearField::Unit::Force ? mass : 1;
}

Vec3 pushOf(const LinearField& f, const Pose& X_WF, const BodyInField& b) {
  return X_WF.q * f.push / divisor(f.unit, b.mass);
}

Vec3 pushOf(const SphericalField& f, const Pose& X_WF, const BodyInField& b) {
  const Vec3 d = b.p - X_WF.p;
  const double r = d.norm();
  if (!(r < f.radius) || r < 1e-12) return Vec3::Zero();
  const double left = 1 - r / f.radius;
  double share = 1;
  if (f.falloff == SphericalField::Falloff::Linear) share = left;
  if (f.falloff == SphericalField::Falloff::Square) share = left * left;
  return d * (f.strength * share / (r * divisor(f.unit, b.mass)));
}

Vec3 pushOf(const PointField& f, const Pose& X_WF, const BodyInField& b) {
  const Vec3 d = b.p - X_WF.p;
  const double square = d.squaredNorm() + f.softening * f.softening;
  if (!(square > 0)) return Vec3::Zero();
  return d * (f.strength / (square * std::sqrt(square) * divisor(f.unit, b.mass)));
}

Vec3 pushOf(const VortexField& f, const Pose& X_WF, const BodyInField& b) {
  const Vec3 axis = X_WF.q * Vec3::UnitZ();
  Vec3 d = b.p - X_WF.p;
  d -= axis * axis.dot(d);
  const double r = d.norm();
  if (!(r < f.radius) || r < 1e-12) return Vec3::Zero();
  const double size = f.strength * (r < f.core ? r / f.core : f.core / r) / divisor(f.unit, b.mass);
  const Vec3 outward = d / r;
  return size * (axis.cross(outward) - f.inward * outward);
}

bool inside(const MediumField& f, const Vec3& local) {
  switch (f.region) {
  case MediumField::Region::Everywhere: return true;
  case MediumField::Region::Ball: return local.norm() < f.half.x();
  case MediumField::Region::Box: return (local.cwiseAbs().array() < f.half.array()).all();
  }
  return false;
}

Vec3 pushOf(const MediumField& f, const Pose& X_WF, const BodyInField& b) {
  if (!inside(f, X_WF.inverse() * b.p - f.centre)) return Vec3::Zero();
  return dragOf(f, X_WF.q, b.mass, b.dragArea).at(b.v);
}

}  // namespace

bool ForceField::uniform() const {
  return std::holds_alternative<LinearField>(law) && start.q.coeffs() == end.q.coeffs() && first == last;
}

const MediumField* ForceField::evenMedium() const {
  const auto* medium = std::get_if<MediumField>(&law);
  if (!medium || medium->region != MediumField::Region::Everywhere) return nullptr;
  const bool steady = start.q.coeffs() == end.q.coeffs() && first == last;
  return medium->wind.isZero(0) || steady ? medium : nullptr;
}

Drag dragOf(const MediumField& f, const Quat& q_WF, double mass, double dragArea) {
  return {f.viscosity, 0.5 * f.density * dragArea / mass, q_WF * f.wind};
}

namespace {

constexpr double kFree = std::numeric_limits<double>::infinity();

/// Towards something so large at that distance.
double stride(double distance, double size) {
  return std::max(distance, 0.0) + 0.4 * size;
}

double strideOf(const LinearField&, const Vec3&) {
  return kFree;
}
double strideOf(const SphericalField& f, const Vec3& local) {
  return stride(local.norm() - f.radius, f.radius);
}
double strideOf(const PointField& f, const Vec3& local) {
  return stride(0.4 * local.norm(), f.softening);
}
double strideOf(const VortexField& f, const Vec3& local) {
  return stride(0.4 * std::sqrt(local.x() * local.x() + local.y() * local.y()), f.core);
}
double strideOf(const MediumField& f, const Vec3& local) {
  const Vec3 d = local - f.centre;
  switch (f.region) {
  case MediumField::Region::Everywhere: return kFree;
  case MediumField::Region::Ball: return stride(d.norm() - f.half.x(), f.half.x());
  case MediumField::Region::Box: return stride((d.cwiseAbs() - f.half).cwiseMax(0).norm(), f.half.minCoeff());
  }
  return kFree;
}

}  // namespace

double strideIn(const ForceField& field, const Vec3& p) {
  const Vec3 local = field.end.inverse() * p;
  return std::visit([&](const auto& law) { return strideOf(law, local); }, field.law);
}

std::optional<Air> airAt(const ForceField& field, const Vec3& p, double s) {
  const auto* medium = std::get_if<MediumField>(&field.law);
  if (!medium) return {};
  const Pose X_WF = field.moving() ? det::interpolate(field.start, field.end, s) : field.end;
  if (!inside(*medium, X_WF.inverse() * p - medium->centre)) return {};
  const double strength = field.first + s * (field.last - field.first);
  return Air{medium->density, X_WF.q * (strength * medium->wind)};
}

FieldLaw scaled(const FieldLaw& law, double factor) {
  FieldLaw to = law;
  if (auto* linear = std::get_if<LinearField>(&to)) linear->push *= factor;
  if (auto* spherical = std::get_if<SphericalField>(&to)) spherical->strength *= factor;
  if (auto* point = std::get_if<PointField>(&to)) point->strength *= factor;
  if (auto* vortex = std::get_if<VortexField>(&to)) vortex->strength *= factor;
  if (auto* medium = std::get_if<MediumField>(&to)) medium->wind *= factor;
  return to;
}

Vec3 accelerationOf(const ForceField& field, const BodyInField& body, double s) {
  const Pose X_WF = field.moving() ? det::interpolate(field.start, field.end, s) : field.end;
  const auto push = [&](const FieldLaw& f) {
    return std::visit([&](const auto& law) { return pushOf(law, X_WF, body); }, f);
  };
  const double strength = field.first + s * (field.last - field.first);
  return strength == 1 ? push(field.law) : push(scaled(field.law, strength));
}

}  // namespace stadion
