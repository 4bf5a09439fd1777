#include "dynamics/state/field_set.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace stadion {
namespace {

constexpr double kAtAllTimes = std::numeric_limits<double>::infinity();

Pose withUnitRotation(const Pose& X) {
  return {X.p, X.q.normalized()};
}

}  // namespace

bool isHooked(const RigidBody& b, FieldId field) {
  return std::ranges::any_of(b.hooks, [&](const Hook& h) { return h.field == field; });
}

FieldId FieldSet::add(const ForceField& field) {
  const FieldId id = nextField_++;
  FieldEntry& f = fields_.add(id);
  f.id = id;
  f.field = field;
  f.changed = true;
  return id;
}

bool FieldSet::move(FieldId id, const Pose& start, const Pose& end) {
  FieldEntry* entry = fields_.find(id);
  if (!entry) return false;
  ForceField& f = entry->field;
  const bool was = f.moving();
  const bool same = f.end.p == start.p && f.end.q.coeffs() == start.q.coeffs();
  f.start = withUnitRotation(start);
  f.end = withUnitRotation(end);
  if (was || !same || f.moving()) entry->changed = true;
  return true;
}

bool FieldSet::setStrength(FieldId id, double start, double end) {
  FieldEntry* entry = fields_.find(id);
  if (!entry || !std::isfinite(start) || !std::isfinite(end)) return false;
  ForceField& f = entry->field;
  entry->changed = entry->changed || f.first != f.last || f.last != start || start != end;
  f.first = start;
  f.last = end;
  return true;
}

bool FieldSet::setLaw(FieldId id, const FieldLaw& law) {
  FieldEntry* f = fields_.find(id);
  if (!f) return false;
  f->changed = f->changed || f->field.law != law;
  f->field.law = law;
  return true;
}

std::vector<FieldId> FieldSet::takeChanged() {
  std::vector<FieldId> different;
  for (FieldEntry& f : fields_) {
    if (f.on && (f.changed || f.field.changing())) different.push_back(f.id);
    f.changed = f.field.changing();  // once it stops, the next frame differs again
  }
  return different;
}

Vec3 FieldSet::accelerationAt(const RigidBody& b, const Vec3& p, const Vec3& v, double tau) const {
  Vec3 a = Vec3::Zero();
  eachFelt(b, [&](const ForceField& f) {
    a += accelerationOf(f, {b.mass, b.dragArea, p, v}, time_.shareAt(tau));
  });
  return a;
}

CoupledPush FieldSet::airPush(const RigidBody& b, const CoupledState& s, const Vec3& omega,
                              double tau) const {
  CoupledPush push{-b.damping * s.v, Vec3::Zero()};
  const double share = time_.shareAt(tau);
  const Quat q_WA = s.q * b.q_CA;
  eachFelt(b, [&](const ForceField& f) {
    push.a += accelerationOf(f, {b.mass, 0, s.p, s.v}, share);
    const auto air = airAt(f, s.p, share);
    if (!air) return;
    const Wrench w = aerodynamics(b.flight->model, air->density, q_WA.conjugate() * (s.v - air->wind),
                                  q_WA.conjugate() * omega);
    push.a += b.inverseMass * (q_WA * w.force);
    push.torque += q_WA * w.torque;
  });
  return push;
}

bool FieldSet::uniformFor(const RigidBody& b) const {
  bool uniform = true;
  eachFelt(b, [&](const ForceField& f) { uniform = uniform && f.uniform(); });
  return uniform;
}

bool FieldSet::feelsChange(const RigidBody& b) const {
  bool changes = false;
  eachFelt(b, [&](const ForceField& f) { changes = changes || f.changing(); });
  return changes;
}

bool FieldSet::inMedium(const RigidBody& b) const {
  bool medium = false;
  eachFelt(b, [&](const ForceField& f) { medium = medium || std::holds_alternative<MediumField>(f.law); });
  return medium;
}

std::optional<EvenPull> FieldSet::evenPullOn(const RigidBody& b) const {
  EvenPull even;
  bool immersed = false, isEven = true;
  eachFelt(b, [&](const ForceField& f) {
    if (f.uniform()) {
      even.pull += accelerationOf(f, {b.mass, b.dragArea}, 1);
      return;
    }
    const MediumField* medium = f.evenMedium();
    isEven = isEven && medium && !immersed;
    if (!isEven) return;
    immersed = true;
    even.drag = dragOf(*medium, f.end.q, b.mass, b.dragArea);
    even.drag.wind *= f.last;
  });
  return isEven ? std::optional(even) : std::nullopt;
}

double FieldSet::knownFor(const RigidBody& b, double tau) const {
  return tau < time_.partEnd() && feelsChange(b) ? time_.partEnd() - tau : kAtAllTimes;
}

double FieldSet::timeToPass(const RigidBody& b, const Vec3& p, const Vec3& v, double more) const {
  double stride = kAtAllTimes;
  eachFelt(b, [&](const ForceField& f) {
    stride = std::min(stride, strideIn(f, p) / std::max(v.norm() + more, 1e-9));
  });
  return std::max(stride, 1e-6);
}

}  // namespace stadion
