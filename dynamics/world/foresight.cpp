#include "dynamics/world/foresight.h"

#include "dynamics/state/held_bodies.h"
#include "dynamics/world/release_watch.h"

#include <algorithm>
#include <cmath>

namespace stadion {
namespace {

bool isHeld(const Side& s) {
  return s.body && s.body->mode == BodyMode::Held;
}

bool isMesh(const Side& s) {
  return std::holds_alternative<MeshShape>(*s.shape);
}

}  // namespace

/// The last tau at which it is known where a side is.
double Foresight::knownUntil(const Side& s) const {
  const GuidedMotion* motion = s.motion();
  if (!motion) return s.body->until;
  if (s.collider && !motion->moving) return time_.windowEnd();
  return motion->guided() ? std::min(time_.partEnd(), motion->nextTurn()) : time_.partEnd();
}

/// Posts the next turn of a guided motion within this frame: contacts are predicted again then.
void Foresight::pushTurn(ContactSide p, const GuidedMotion& motion, double tau) {
  const double turns = std::max(tau, motion.nextTurn() + kTurnTolerance);
  if (!motion.guided() || !(turns <= std::min(time_.partEnd(), time_.windowEnd()))) return;
  queue_.postHorizon(turns, p, objects_.versionOf(p));
}

void Foresight::pushHorizon(const RigidBody& b) {
  if (b.mode == BodyMode::Held) return pushTurn({true, b.id}, b.grip.held, time_.partStart());
  if (!(b.until <= time_.windowEnd()) || b.mode == BodyMode::Contact) return;
  queue_.postHorizon(std::max(b.until, time_.partStart()), {true, b.id}, b.version);
}

void Foresight::predictPair(const Side& a, const Side& b, double tau) {
  if (a.still() && b.still()) return;
  if (!objects_.mayTouch(a, b)) return;
  for (const auto& [s, o] : {std::pair(&a, &b), std::pair(&b, &a)}) {
    if (!s->body) continue;
    // The solver, or the closed form of a ball on a face, handles pairs in lasting contact.
    if (s->body->mode == BodyMode::Contact &&
        std::find(s->body->contact.touching.begin(), s->body->contact.touching.end(), o->key) !=
            s->body->contact.touching.end())
      return;
    if (s->body->mode != BodyMode::Flight && s->body->support.on.id && s->body->support.on == o->key &&
        !std::holds_alternative<MeshShape>(*o->shape))
      return;
  }
  if (bothCarried(a, b)) {
    // Such a pair has no impulse; only its first touch is reported.
    if (!isHeld(a) && !isHeld(b)) return;
    const ContactMemory::Key key = ContactMemory::keyOf(a.key, b.key);
    if (memory_.touching(key)) {
      const double known = std::min({time_.partEnd(), time_.windowEnd(), knownUntil(a), knownUntil(b)});
      // On a straight way a convex pair that has parted does not meet again.
      const bool mayMeetAgain = a.guided() || b.guided() || isMesh(a) || isMesh(b);
      const auto parted =
          mayMeetAgain ? firstBeyond(a, b, kCarriedApart, tau, known) : std::optional<double>();
      if (!parted) return;
      memory_.setTouching(key, false);
      tau = *parted;
    }
  }
  ++counters_.pairTests;
  if (a.body && b.body) ++predictions_.bodies;
  // Contacts are searched up to the end of the shorter arc.
  const double to = std::min({time_.windowEnd(), knownUntil(a), knownUntil(b)});
  if (!(tau <= to)) return;
  const double beyond = a.guided() || b.guided() ? to + kTurnTolerance : to;
  const auto touch = surfaces_.firstRealTouch(a, b, tau, beyond);
  if (!touch) return;
  queue_.postTouch(std::min(touch->tau, to), a, b, *touch);
}

void Foresight::predict(RigidBody& b, double tau) {
  if (!changes_.immediate()) return changes_.mark(b);
  const Aabb before = b.swept;
  boxes_.sweep(b, tau);
  if (!b.enabled) return;
  if (b.atMostOneNear && b.place != kUnfiled &&
      holds(before, b.swept)) {  // nothing new is in the swept space
    b.swept = before;
    predictNearCollider(b, tau);
  } else {
    predictNearby(b, tau, false);
  }
}

void Foresight::predictNearby(RigidBody& b, double tau, bool onlyHigherIds) {
  if (b.contact.inPile) return;  // the step of the pile contains all bodies that could touch it
  const Side self = Side::of(b);
  b.atMostOneNear = true;
  b.nearCollider = 0;
  ++predictions_.arcs;
  boxes_.eachCollider(b.swept, [&](Collider& c) {
    b.atMostOneNear = b.atMostOneNear && b.nearCollider == 0;
    b.nearCollider = c.id;
    ++predictions_.colliders;
    predictPair(self, Side::of(c), tau);
  });
  boxes_.eachBody(b.swept, [&](RigidBody& o) {
    if (&o == &b) return;
    b.atMostOneNear = false;
    comeNear(o, tau);
    if (onlyHigherIds && o.marked && o.id < b.id) return;
    predictPair(self, Side::of(o), tau);
  });
  awaitHorizon(b);
}

/// Called when the contacts of the body are predicted. Its next arc begins in time, or on request.
void Foresight::awaitHorizon(RigidBody& b) {
  // What its next arcs sweep is known if they go through the same medium.
  b.lazy = b.atMostOneNear && b.nearCollider == 0 && b.mode == BodyMode::Flight &&
           (b.path.isSeries() || b.pathAge - b.age0 > time_.windowEnd());
  if (!b.lazy) pushHorizon(b);
}

/// Begins the next arc of a lazy body.
void Foresight::flyOnLazily(RigidBody& b) {
  arcs_.flyOn(b, b.until);
  b.lazy = b.mode == BodyMode::Flight;
}

/// Something has come near what the body sweeps: it stops being lazy.
void Foresight::comeNear(RigidBody& b, double tau) {
  b.atMostOneNear = false;
  if (!b.lazy) return;
  catchUp(b, tau);
  b.lazy = false;
  pushHorizon(b);
}

/// Predicts as predictNearby() does, for a body that is near one collider at most and goes where it was seen
/// to go.
void Foresight::predictNearCollider(RigidBody& b, double tau) {
  pushHorizon(b);
  ++predictions_.arcs;
  const Collider* c = b.nearCollider ? objects_.collider(b.nearCollider) : nullptr;
  if (!c || !c->enabled) return;
  ++predictions_.colliders;
  predictPair(Side::of(b), Side::of(*c), tau);
}

void Foresight::predictChanged(double tau) {
  for (RigidBody* b : changes_.bodies())
    if (b->enabled) predictNearby(*b, tau, true);
  for (const ColliderId id : changes_.colliders()) {
    Collider* c = objects_.collider(id);
    if (!c || !c->enabled) continue;
    boxes_.eachBody(c->swept, [&](RigidBody& o) {
      if (o.marked) return;  // it has just seen the collider itself
      comeNear(o, tau);
      predictPair(Side::of(o), Side::of(*c), tau);
    });
    pushTurn({false, id}, c->motion, tau);
  }
  changes_.clearBodies();
}

/// Returns true if a long search could be expensive: solids that could meet something take small steps.
bool Foresight::solidsMayMeet() const {
  constexpr std::size_t kFew = 64;
  std::size_t solids = 0;
  for (const RigidBody* b : active_)
    if (!b->centred && !standsStill(b->mode)) ++solids;
  return solids > kFew || (solids > 0 && !objects_.colliders().empty());
}

/// While no bodies come near each other and little else is near, one long look costs less than many short
/// ones. The result does not depend on frames.
Nanoseconds Foresight::nextWindow() const {
  bool moves = false, lazy = true;
  for (const RigidBody* b : active_) {
    if (standsStill(b->mode)) continue;
    moves = true;
    lazy = lazy && b->lazy;
  }
  if (!moves || predictions_.bodies > 0 || (!lazy && solidsMayMeet())) return WorldTime::kWindow;
  if (predictions_.colliders > 2 * predictions_.arcs) return std::max(time_.window() / 2, WorldTime::kWindow);
  return std::min(2 * time_.window(), WorldTime::kLongestWindow);
}

std::size_t Foresight::ballsAround(const RigidBody& b, double tau) {
  if (!b.isBall()) return 0;
  std::size_t many = 0;
  const Vec3 middle = b.position(tau);
  const double reach = 2 * b.bound.radius;
  Aabb box;
  box.include(middle);
  box.lo.array() -= reach;
  box.hi.array() += reach;
  eachBodyNear(box, tau, [&](const RigidBody& o) {
    if (&o == &b || !o.enabled || !o.isBall()) return;
    if (o.mode != BodyMode::Flight && o.mode != BodyMode::Contact) return;
    const double far = reach + o.bound.radius;
    if ((o.position(tau) - middle).squaredNorm() < far * far) ++many;
  });
  return many;
}

void Foresight::predictSpin(RigidBody& b, double tau) {
  if (b.atMostOneNear)
    predictNearCollider(b, tau);
  else
    predict(b, tau);
}

void Foresight::predict(Collider& c, double tau) {
  boxes_.eachBody(c.swept, [&](RigidBody& o) {
    comeNear(o, tau);
    predictPair(Side::of(o), Side::of(c), tau);
  });
  pushTurn({false, c.id}, c.motion, tau);
}

void Foresight::fillWindow(double tau) {
  boxes_.sortCollidersIfCrowded();
  boxes_.sweep(active_, tau);
  if (time_.window() > WorldTime::kWindow && solidsMayMeet()) {
    if (!boxes_.anyNear(active_)) {
      for (RigidBody* b : active_) {
        b->atMostOneNear = true;
        b->nearCollider = 0;
        awaitHorizon(*b);
      }
      return;
    }
    time_.shortenWindow();
    boxes_.sweep(active_, tau);
  }
  for (RigidBody* b : active_) changes_.mark(*b);
  changes_.sortBodies();
  predictChanged(tau);
}

}  // namespace stadion
