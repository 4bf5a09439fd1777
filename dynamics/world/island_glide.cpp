#include "dynamics/world/island_step.h"

#include <algorithm>
#include <cmath>

namespace stadion {
namespace {

constexpr double kGlideStill = 1e-9;     ///< slower than this is not at all [m/s]
constexpr double kBalanced = 1e-7;       ///< accelerations below this are rounding [m/s2]
constexpr double kProbe = 1e-4;          ///< step in which accelerations are measured [s]
constexpr double kFarthest = 1;          ///< how long a glide is foreseen at most [s]
constexpr double kShortestGlide = 1e-7;  ///< and at least [s]

/// Returns true if no body turns or is damped, and none is pushed out of another.
bool mayGlide(const ContactIsland& s) {
  for (std::size_t i = 0; i < s.set.size(); ++i) {
    const RigidBody& b = *s.set[i];
    if (s.start[i].omega.norm() * b.reach > kGlideStill || b.damping > 0) return false;
  }
  return std::ranges::none_of(s.found, [](const FoundContact& f) { return f.gap.distance < -kIslandSlop; });
}

/// Stretches a probe's step to a glide.
void stretch(ContactIsland& s, double probe, double seconds) {
  for (std::size_t i = 0; i < s.set.size(); ++i) {
    s.start[i].omega.setZero();
    s.end[i].omega.setZero();
    s.end[i].v = s.start[i].v + (s.end[i].v - s.start[i].v) / probe * seconds;
  }
  for (FoundContact& f : s.found) f.contact.impulse *= seconds / probe;
  for (FlatPatch& f : s.flats) f.contact.impulse *= seconds / probe;
}

}  // namespace

bool IslandStep::isMesh(ContactSide p) const {
  return std::holds_alternative<MeshShape>(*objects_.side(p)->shape);
}

/// Returns how long the slip at a contact stays as it is, at most `most`; 0 if not at all. Adds to `way` the
/// pieces that the contact point reaches.
double IslandStep::glideAt(const ContactIsland& s, const FoundContact& f, double probe, double most,
                           std::vector<ContactSide>& way) {
  const SolverContact& c = f.contact;
  const Vec3 n = f.gap.normal, u = s.start[c.a].v - s.start[c.b].v,
             a = (s.end[c.a].v - s.end[c.b].v - u) / probe;
  const double un = u.dot(n), an = a.dot(n);
  if (isMesh(f.a) || isMesh(f.b)) return 0;            // other parts of it may be in the way
  if (un < -kGlideStill || an < -kBalanced) return 0;  // what nears it may hit it
  if (un > kGlideStill || an > kBalanced || c.impulse[0] <= 0) return most;
  const Vec3 ut = u - un * n, at = a - an * n;
  const double speed = ut.norm(), change = at.norm();
  if (speed <= kGlideStill && change <= kBalanced) return most;
  if (ut.cross(at).norm() > 1e-9 * speed * (change + 1)) return 0;  // the slip turns
  if (ut.dot(at) < 0 && c.friction > 0) most = std::min(most, speed / change);
  // Faces must go on carrying the same points.
  if (f.b.isBody || f.carrier != Carrier::A) return 0;
  return std::min(most,
                  surfaces_.timeCarried(*s.set[c.a], f.b.id, f.gap, f.contact.friction, ut, at, most, way));
}

/// Returns the time for which the whole island glides; infinite if all are at rest for good.
double IslandStep::glideOf(const ContactIsland& s, double probe, std::vector<ContactSide>& way) {
  double fastest = 0, strongest = 0;
  for (std::size_t i = 0; i < s.set.size(); ++i) {
    const RigidBody& b = *s.set[i];
    const Vec3 a = (s.end[i].v - s.start[i].v) / probe;
    const double alpha = (s.end[i].omega - s.start[i].omega).norm() / probe * b.reach;
    if (alpha > kBalanced) return 0;
    fastest = std::max(fastest, s.start[i].v.norm());
    strongest = std::max(strongest, a.norm());
    if (!fields_.uniformFor(b) && (s.start[i].v.norm() > kGlideStill || a.norm() > kBalanced)) return 0;
  }
  if (fastest <= kGlideStill && strongest <= kBalanced)  // what changes may stir them in this very frame
    return std::ranges::any_of(s.set, [&](const RigidBody* b) { return fields_.feelsChange(*b); }) ? 0
                                                                                                   : kForGood;
  double most = kFarthest;
  for (const FoundContact& f : s.found) {
    most = glideAt(s, f, probe, most, way);
    if (!(most > kShortestGlide)) return 0;
  }
  return most;
}

/// Bodies that do not turn, on faces that they do not leave, keep their accelerations until a slip ends: how
/// long that lasts, 0 if not even for this step, kForGood if all are at rest.
double IslandStep::glide(ContactIsland& s, double tau, double h) {
  if (s.carried || !mayGlide(s)) return 0;
  const double probe = std::min(h, kProbe);
  if (!solveStep(s, tau, probe, Effort::AtRest)) return 0;
  std::vector<ContactSide> way;  // of faces that the points come to
  const double most = glideOf(s, probe, way);
  if (!(most > 0) || most == kForGood) return most;
  stretch(s, probe, most);
  s.way = std::move(way);
  return most;
}

}  // namespace stadion
