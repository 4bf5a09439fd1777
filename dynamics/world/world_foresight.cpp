#include "dynamics/world/world_core.h"

#include <algorithm>
#include <cmath>

namespace stadion {
namespace {

bool isHeld(const Side& s) {
  return s.body && s.body->mode == BodyMode::Held;
}

}  // namespace

/// The last tau at which it is known where a side is.
double World::Core::knownUntil(const Side& s) const {
  const GuidedMotion* motion = s.motion();
  if (!motion) return s.body->until;
  if (s.collider && !motion->moving) return time_.windowEnd();
  return motion->guided() ? std::min(time_.now(), motion->nextTurn()) : time_.now();
}

/// Its way goes on otherwise before the frame is over: what it meets then must be looked at again.
void World::Core::pushTurn(Party p, const GuidedMotion& motion, double tau) {
  const double turns = std::max(tau, motion.nextTurn() + kTurnsLate);
  if (!motion.guided() || !(turns <= std::min(time_.now(), time_.windowEnd()))) return;
  queue_.postHorizon(turns, p, objects_.versionOf(p));
}

void World::Core::turn(RigidBody& b, double tau) {
  ++b.held.part, ++b.version;
  wakeOnto({true, b.id}, tau);
  predict(b, tau);
}

void World::Core::turn(Collider& c, double tau) {
  ++c.motion.part, ++c.version;
  wakeOnto({false, c.id}, tau);
  boxes_.eachBody(c.swept, [&](RigidBody& o) {
    comeNear(o, tau);
    predictPair(Side::of(o), Side::of(c), tau);
  });
  pushTurn({false, c.id}, c.motion, tau);
}

void World::Core::pushHorizon(const RigidBody& b) {
  if (b.mode == BodyMode::Held) return pushTurn({true, b.id}, b.held, time_.from());
  if (!(b.until <= time_.windowEnd()) || b.mode == BodyMode::Contact) return;
  queue_.postHorizon(std::max(b.until, time_.from()), {true, b.id}, b.version);
}

void World::Core::predictPair(const Side& a, const Side& b, double tau) {
  if (a.still() && b.still()) return;
  if (!objects_.mayTouch(a, b)) return;
  for (const auto& [s, o] : {std::pair(&a, &b), std::pair(&b, &a)}) {
    if (!s->body) continue;
    // What lasting contact is with is the solver's or the closed form's business.
    if (s->body->mode == BodyMode::Contact &&
        std::find(s->body->touching.begin(), s->body->touching.end(), o->party) != s->body->touching.end())
      return;
    if (s->body->mode != BodyMode::Flight && s->body->support.on.id && s->body->support.on == o->party &&
        !std::holds_alternative<MeshShape>(*o->shape))
      return;
  }
  if (bothCarried(a, b)) {
    // Nothing comes of it but the news that they touch, once.
    if (!isHeld(a) && !isHeld(b)) return;
    const ContactMemory::Key key = ContactMemory::keyOf(a.party, b.party);
    if (memory_.touching(key)) {
      const double known = std::min({time_.now(), time_.windowEnd(), knownUntil(a), knownUntil(b)});
      const auto parted =
          a.guided() || b.guided() ? firstBeyond(a, b, kCarriedApart, tau, known) : std::optional<double>();
      if (!parted) return;
      memory_.setTouching(key, false);
      tau = *parted;
    }
  }
  ++counters.pairTests;
  if (a.body && b.body) ++looks.bodies;
  // An arc that ends before the window is only asked up to its end.
  const double to = std::min({time_.windowEnd(), knownUntil(a), knownUntil(b)});
  if (!(tau <= to)) return;
  const double beyond = a.guided() || b.guided() ? to + kTurnsLate : to;
  const auto touch = firstRealTouch(a, b, tau, beyond);
  if (!touch) return;
  queue_.postTouch(std::min(touch->tau, to), a, b, *touch);
}

/// What the body's new arc meets from tau to the end of the window.
void World::Core::predict(RigidBody& b, double tau, bool onlyGreater) {
  if (!changes_.immediate()) return changes_.mark(b);
  const Aabb before = b.swept;
  boxes_.sweep(b, tau);
  if (!b.enabled) return;
  if (b.alone && b.place != kUnfiled && holds(before, b.swept)) {  // nobody else is where it goes
    b.swept = before;
    lookAtOnly(b, tau);
  } else {
    lookAhead(b, tau, onlyGreater);
  }
}

void World::Core::lookAhead(RigidBody& b, double tau, bool onlyGreater) {
  if (b.crowd) return;  // whoever could touch it within its step has been taken into the step
  const Side self = Side::of(b);
  b.alone = true, b.only = 0;
  ++looks.looks;
  boxes_.eachCollider(b.swept, [&](Collider& c) {
    b.alone = b.alone && b.only == 0;
    b.only = c.id;
    ++looks.colliders;
    predictPair(self, Side::of(c), tau);
  });
  boxes_.eachBody(b.swept, [&](RigidBody& o) {
    if (&o == &b) return;
    b.alone = false;
    comeNear(o, tau);
    if (onlyGreater && o.marked && o.id < b.id) return;
    predictPair(self, Side::of(o), tau);
  });
  awaitHorizon(b);
}

/// The body has been looked at: its next arc begins in time, or when somebody asks for it.
void World::Core::awaitHorizon(RigidBody& b) {
  // What its next arcs sweep is known if they go through the same medium.
  b.lazy = b.alone && b.only == 0 && b.mode == BodyMode::Flight &&
           (b.path.isSeries() || b.pathAge - b.age0 > time_.windowEnd());
  if (!b.lazy) pushHorizon(b);
}

/// The next arc of a lazy body, which nobody has asked for yet.
void World::Core::flyOnLazily(RigidBody& b) {
  flyOn(b, b.until);
  b.lazy = b.mode == BodyMode::Flight;
}

/// Something has come near what the body sweeps: it is one who must be watched.
void World::Core::comeNear(RigidBody& b, double tau) {
  b.alone = false;
  if (!b.lazy) return;
  catchUp(b, tau);
  b.lazy = false;
  pushHorizon(b);
}

/// The same for one who is alone and goes nowhere else than it was seen to go.
void World::Core::lookAtOnly(RigidBody& b, double tau) {
  pushHorizon(b);
  ++looks.looks;
  const Collider* c = b.only ? objects_.collider(b.only) : nullptr;
  if (!c || !c->enabled) return;
  ++looks.colliders;
  predictPair(Side::of(b), Side::of(*c), tau);
}

/// Looks ahead from tau for everybody who is marked and for colliders that were told something.
void World::Core::foreseeMarked(double tau) {
  for (RigidBody* b : changes_.bodies())
    if (b->enabled) lookAhead(*b, tau, true);
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

/// Whether far looks could be dear: solids that could meet something take small steps.
bool World::Core::solidsMayMeet() const {
  constexpr std::size_t kFew = 64;
  std::size_t solids = 0;
  for (const RigidBody* b : active_)
    if (!b->centred && !standsStill(b->mode)) ++solids;
  return solids > kFew || (solids > 0 && !objects_.colliders().empty());
}

/// How long the next window is to be: while nobody comes near anybody else and little else is near, far looks
/// cost less than many. What it depends on does not depend on frames.
Nanoseconds World::Core::nextWindow() const {
  bool moves = false, lazy = true;
  for (const RigidBody* b : active_) {
    if (standsStill(b->mode)) continue;
    moves = true, lazy = lazy && b->lazy;
  }
  if (!moves || looks.bodies > 0 || (!lazy && solidsMayMeet())) return WorldTime::kWindow;
  if (looks.colliders > 2 * looks.looks) return std::max(time_.window() / 2, WorldTime::kWindow);
  return std::min(2 * time_.window(), WorldTime::kLongestWindow);
}

/// All clocks go by a new window.
void World::Core::beginWindow(Nanoseconds at) {
  time_.openWindow(at, nextWindow());
  looks = {};
  queue_.clear();
  const Instant start{time_.origin(), 0};
  const double from = std::max(0.0, time_.from());
  for (RigidBody& b : objects_.bodies()) {
    b.age0 = start.since(b.since);
    b.until = b.validAge - b.age0;
    b.held.begin = time_.from(), b.held.rebase(start);
  }
  for (Collider& c : objects_.colliders()) c.motion.begin = time_.from(), c.motion.rebase(start);
  scheduleDue(from);
  commands_.postAll();
}

/// A window begins: everybody is looked at anew.
void World::Core::openWindow(Nanoseconds at) {
  beginWindow(at);
  const double from = std::max(0.0, time_.from());
  boxes_.sortCollidersIfCrowded();
  boxes_.sweep(active_, from);
  if (time_.window() > WorldTime::kWindow && solidsMayMeet()) {
    if (!boxes_.anyNear(active_)) {
      for (RigidBody* b : active_) b->alone = true, b->only = 0, awaitHorizon(*b);
      return;
    }
    time_.shortenWindow();
    boxes_.sweep(active_, from);
  }
  for (RigidBody* b : active_) changes_.mark(*b);
  changes_.sortBodies();
  foreseeMarked(from);
}

}  // namespace stadion
