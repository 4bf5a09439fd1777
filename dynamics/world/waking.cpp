#include "dynamics/world/waking.h"

#include <algorithm>

namespace stadion {

void Waking::enterContact(RigidBody& b, double tau) {
  if (b.mode == BodyMode::Contact || !b.movable()) return;
  const Vec3 L = b.spin.angularMomentum(b.spinAge(tau));
  // In a pile it moves with the pile: between the steps of the pile no other body gives way.
  const bool rests = b.mode == BodyMode::Rest;
  const bool pileMember =
      rests && (b.contact.restsInPile || std::ranges::any_of(b.contact.touching, [&](ContactSide p) {
                  return p.isBody && objects_.body(p.id) && objects_.body(p.id)->contact.inPile;
                }));
  b.support.on = {};
  arcs_.setArc(b, tau, Path::parabola(b.position(tau), b.velocity(tau), Vec3::Zero()),
               Spin::free(b.orientation(tau), L, b.inertia), grid_.islandStep(), BodyMode::Contact);
  b.contact.endL = L;
  b.contact.quietTime = 0;
  if (!rests) b.contact.warmStarts.clear();
  if (pileMember && b.mode == BodyMode::Contact) {
    b.contact.inPile = true;
    b.contact.dueAge = grid_.untilPileStep(time_.instantAt(tau));
  }
  queue_.scheduleTick(tau);
}

/// What acts on the body changes: its step ends here and a new one begins, from what it does now.
void Waking::cutStep(RigidBody& b, double tau) {
  if (b.mode != BodyMode::Contact) return;
  const Vec3 L = b.angularMomentum(tau);
  arcs_.setArc(b, tau, Path::parabola(b.position(tau), b.velocity(tau), Vec3::Zero()),
               Spin::free(b.orientation(tau), L, b.inertia), grid_.islandStep(), BodyMode::Contact);
  b.contact.endL = L;
  b.contact.quietTime = 0;
  queue_.scheduleTick(tau);
}

/// Predicts again what was predicted for longer than a step.
void Waking::hurry(RigidBody& b, double tau) {
  if (b.mode != BodyMode::Contact || b.contact.inPile || b.contact.dueAge <= grid_.islandStep() ||
      b.age(tau) + grid_.islandStep() >= b.contact.dueAge)
    return;
  b.contact.dueAge = 0;
  queue_.scheduleTick(tau);
}

/// Sleepers that lean on a waking one wake with it.
void Waking::wake(RigidBody& b, double tau) {
  if (b.mode != BodyMode::Rest) return;
  if (b.support.on.id) {
    restart(b, tau);
    if (b.mode == BodyMode::Rest) return;
  } else {
    enterContact(b, tau);
  }
  wakeOnto({true, b.id}, tau);
}

void Waking::wakeOnto(ContactSide moved, double tau) {
  if (!supports_.bears(moved)) return;
  std::vector<ContactSide> waking{moved};
  std::vector<BodyId> onIt;
  for (std::size_t i = 0; i < waking.size(); ++i) {
    const ContactSide gone = waking[i];
    onIt.clear();
    supports_.leanersOf(gone, onIt);
    for (const BodyId id : onIt) {
      RigidBody* other = objects_.body(id);
      if (!other || !leansOn(*other, gone)) {
        supports_.drop(gone, id);
        continue;
      }
      if (wakeLeaner(*other, gone, tau)) waking.push_back({true, id});
    }
  }
}

/// Wakes a body that leans on `gone`. Returns true if the bodies that lean on this body have to wake, too.
bool Waking::wakeLeaner(RigidBody& b, const ContactSide& gone, double tau) {
  const bool onFace = b.mode == BodyMode::Rest || b.mode == BodyMode::Slide || b.mode == BodyMode::Roll;
  if (onFace && b.support.on.id && b.support.on == gone) {
    fly(b, tau, b.velocity(tau), b.spin.angularMomentum(b.spinAge(tau)));
    return true;
  }
  switch (b.mode) {
  case BodyMode::Stuck: fly(b, tau, Vec3::Zero(), Vec3::Zero()); return true;
  case BodyMode::Contact: hurry(b, tau); return false;
  case BodyMode::Rest: {
    // In a pile, bodies that lean on it wake when it moves; elsewhere nothing would wake them.
    const bool alone = !b.contact.restsInPile;
    enterContact(b, tau);
    return alone;
  }
  default: return false;
  }
}

void Waking::fly(RigidBody& b, double tau, const Vec3& v, const Vec3& angularMomentum) {
  arcs_.startFlight(b, tau, b.position(tau), v, b.orientation(tau), angularMomentum);
  foresight_.predict(b, tau);
}

/// The next tick is when the first body in contact is due.
void Waking::scheduleDue(double tau) {
  double first = 1e300;
  for (const RigidBody* b : active_)
    if (b->mode == BodyMode::Contact && b->enabled) first = std::min(first, b->contact.dueAge - b->age0);
  if (first < 1e299) queue_.scheduleTick(std::max(first, tau));
}

/// A new arc from the present state, because what acts on the body has changed.
void Waking::restart(RigidBody& b, double tau) {
  foresight_.catchUp(b, tau);
  switch (b.mode) {
  case BodyMode::Flight: {
    const Vec3 p = b.position(tau), v = b.velocity(tau);
    arcs_.continueFlight(b, tau, p, v, false);
    break;
  }
  case BodyMode::Slide:
  case BodyMode::Roll:
  case BodyMode::Rest:
    if (b.support.on.id) {
      const bool rested = b.mode == BodyMode::Rest;
      arcs_.startOnFace(
          b, tau,
          {b.position(tau), b.velocity(tau), b.spin.angularVelocity(b.spinAge(tau)), b.orientation(tau)},
          false, false);
      if (rested && b.mode != BodyMode::Rest) wakeOnto({true, b.id}, tau);
    } else {
      wake(b, tau);
    }
    break;
  case BodyMode::Contact: cutStep(b, tau); return;
  default: return;
  }
  foresight_.predict(b, tau);
}

}  // namespace stadion
