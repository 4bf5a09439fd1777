#include "dynamics/world/world_core.h"

#include <algorithm>
#include <cmath>

namespace stadion {
namespace {

bool isHeld(const Side& s) {
  return s.body && s.body->mode == BodyMode::Held;
}

constexpr double kMargin = 2e-6;  ///< so that a fresh arc of the same motion stays inside [m]

/// Makes room in the box for wherever the body's further arcs through a medium may go in `d` seconds after
/// tau, at which the box holds it.
void reachOn(const RigidBody& b, double tau, double d, Aabb& box) {
  const Vec3 v = b.velocity(tau), p = b.position(tau) + d * v;
  const Vec3 room = Vec3::Constant(b.reach + kMargin) + 0.5 * d * d * b.even.accelerationBound(v, d);
  box.include(p - room), box.include(p + room);
}

bool holds(const Aabb& outer, const Aabb& inner) {
  return (outer.lo.array() <= inner.lo.array()).all() && (inner.hi.array() <= outer.hi.array()).all();
}

/// The box around a body from tau to `to`, however it turns.
Aabb sweptBody(const RigidBody& b, double tau, double to) {
  const Vec3 p0 = b.position(tau), p1 = b.position(to);
  Aabb box{p0.cwiseMin(p1), p0.cwiseMax(p1)};
  Vec3 sag = Vec3::Zero();
  if (b.path.isParabola()) {
    const auto& c = b.path.c;
    const Vec3 v0 = c[1] + b.age(tau) * (2 * c[2]), v1 = c[1] + b.age(to) * (2 * c[2]);
    for (int i = 0; i < 3;
         ++i)  // it turns back on the way: a parabola's vertex is this far beyond its ends at most
      if (v0[i] * v1[i] < 0) sag[i] = std::fabs(c[2][i]) * (to - tau) * (to - tau) / 4;
  } else {
    const Vec3 most = b.path.isSeries() ? b.even.accelerationBound(b.velocity(tau), to - tau)
                                        : Vec3::Constant(b.path.accelerationBound());
    sag = (to - tau) * (to - tau) / 8 * most;
  }
  const double margin = b.reach + kMargin + 1e-12 * p0.cwiseAbs().maxCoeff();
  sag.array() += margin;
  box.lo -= sag, box.hi += sag;
  return box;
}

}  // namespace

/// Whether both are moved from outside, so that no impulse can change either.
bool World::Core::bothCarried(const Side& a, const Side& b) {
  return !(a.body && a.body->movable()) && !(b.body && b.body->movable());
}

std::uint32_t World::Core::versionOf(Party p) const {
  if (p.isBody) {
    const RigidBody* b = body(p.id);
    return b ? b->version : 0;
  }
  const Collider* c = collider(p.id);
  return c ? c->version : 0;
}

/// Whether the two are to collide at all.
bool World::Core::mayTouch(const Side& a, const Side& b) const {
  if (a.body && b.body && !bodiesCollide) return false;
  if (ignored.empty()) return true;
  return !ignored.count(a.party < b.party ? std::pair(a.party, b.party) : std::pair(b.party, a.party));
}

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
  queue_.postHorizon(turns, p, versionOf(p));
}

void World::Core::turn(RigidBody& b, double tau) {
  ++b.held.part, ++b.version;
  wakeOnto({true, b.id}, tau);
  predict(b, tau);
}

void World::Core::turn(Collider& c, double tau) {
  ++c.motion.part, ++c.version;
  wakeOnto({false, c.id}, tau);
  nearBodies.eachNear(c.swept, [&](RigidBody& o) {
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
  if (!mayTouch(a, b)) return;
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
    if (memory.touching(key)) {
      const double known = std::min({time_.now(), time_.windowEnd(), knownUntil(a), knownUntil(b)});
      const auto parted =
          a.guided() || b.guided() ? firstBeyond(a, b, kCarriedApart, tau, known) : std::optional<double>();
      if (!parted) return;
      memory.setTouching(key, false);
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

/// Where the body goes until the end of the window, for the broad phase.
void World::Core::sweep(RigidBody& b, double tau) {
  if (!b.enabled) return nearBodies.remove(b);
  if (b.mode == BodyMode::Held) {
    b.swept = sweptBox(Side::of(b), std::max(tau, time_.from()), std::max({tau, time_.from(), time_.now()}));
  } else {
    const double end = b.pathAge - b.age0;
    Aabb box = sweptBody(b, tau, std::max(tau, std::min(time_.windowEnd(), end)));
    if (b.crowd) {  // steps are short and many: a roomy box serves several
      if (b.place != kUnfiled && holds(b.swept, box)) return;
      const double room = 0.004 + 0.05 * b.velocity(tau).norm();
      b.swept.lo = box.lo.array() - room, b.swept.hi = box.hi.array() + room;
    } else {
      if (b.path.isSeries() && tau < end && end < time_.windowEnd())
        reachOn(b, end, time_.windowEnd() - end, box);
      b.swept = box;
    }
  }
  nearBodies.put(b, b.swept);
}

/// What the body's new arc meets from tau to the end of the window.
void World::Core::predict(RigidBody& b, double tau, bool onlyGreater) {
  if (!foresee) return mark(b);
  const Aabb before = b.swept;
  sweep(b, tau);
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
  nearColliders.eachNear(b.swept, [&](Collider& c) {
    b.alone = b.alone && b.only == 0;
    b.only = c.id;
    ++looks.colliders;
    predictPair(self, Side::of(c), tau);
  });
  nearBodies.eachNear(b.swept, [&](RigidBody& o) {
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
  const Collider* c = b.only ? collider(b.only) : nullptr;
  if (!c || !c->enabled) return;
  ++looks.colliders;
  predictPair(Side::of(b), Side::of(*c), tau);
}

void World::Core::mark(RigidBody& b) {
  if (b.marked) return;
  b.marked = true;
  marked.push_back(&b);
}

void World::Core::sortMarked() {
  if (!std::ranges::is_sorted(marked, {}, &RigidBody::id)) std::ranges::sort(marked, {}, &RigidBody::id);
}

void World::Core::sweepMarked() {
  sortMarked();
  for (RigidBody* b : marked) sweep(*b, time_.from());
  if (nearBodies.crowded()) fileBodies();
  if (nearColliders.crowded()) fileColliders();
}

/// Looks ahead from tau for everybody who is marked and for colliders that were told something.
void World::Core::foreseeMarked(double tau) {
  for (RigidBody* b : marked)
    if (b->enabled) lookAhead(*b, tau, true);
  for (const ColliderId id : told) {
    Collider* c = collider(id);
    if (!c || !c->enabled) continue;
    nearBodies.eachNear(c->swept, [&](RigidBody& o) {
      if (o.marked) return;  // it has just seen the collider itself
      comeNear(o, tau);
      predictPair(Side::of(o), Side::of(*c), tau);
    });
    pushTurn({false, id}, c->motion, tau);
  }
  for (RigidBody* b : marked) b->marked = false;
  marked.clear();
}

void World::Core::fileBodies() {
  std::vector<BroadPhase<RigidBody>::Entry> entries;
  entries.reserve(bodies.size());
  for (RigidBody& b : bodies)
    if (b.enabled) entries.push_back({b.swept, &b});
  nearBodies.file(std::move(entries));
}

void World::Core::fileColliders() {
  std::vector<BroadPhase<Collider>::Entry> entries;
  for (Collider& c : colliders)
    if (c.enabled) entries.push_back({c.swept, &c});
  nearColliders.file(std::move(entries));
}

void World::Core::sweep(Collider& c) {
  if (!c.enabled) return nearColliders.remove(c);
  if (c.motion.moving) {
    c.swept = sweptBox(Side::of(c), time_.from(), std::max(time_.from(), time_.now()));
  } else {
    constexpr double margin = 2e-5;  // so that whoever touches it at load is seen
    c.swept = boundingBox(*c.shape, c.motion.end);
    c.swept.lo.array() -= margin, c.swept.hi.array() += margin;
  }
  nearColliders.put(c, c.swept);
}

/// Whether far looks could be dear: solids that could meet something take small steps.
bool World::Core::solidsMayMeet() const {
  constexpr std::size_t kFew = 64;
  std::size_t solids = 0;
  for (const RigidBody* b : active)
    if (!b->centred && !standsStill(b->mode)) ++solids;
  return solids > kFew || (solids > 0 && !colliders.empty());
}

/// How long the next window is to be: while nobody comes near anybody else and little else is near, far looks
/// cost less than many. What it depends on does not depend on frames.
Nanoseconds World::Core::nextWindow() const {
  bool moves = false, lazy = true;
  for (const RigidBody* b : active) {
    if (standsStill(b->mode)) continue;
    moves = true, lazy = lazy && b->lazy;
  }
  if (!moves || looks.bodies > 0 || (!lazy && solidsMayMeet())) return WorldTime::kWindow;
  if (looks.colliders > 2 * looks.looks) return std::max(time_.window() / 2, WorldTime::kWindow);
  return std::min(2 * time_.window(), WorldTime::kLongestWindow);
}

/// Whether a body that moves sweeps a box that something else is near.
bool World::Core::anyoneNear() const {
  bool near = false;
  for (const RigidBody* b : active) {
    if (near) break;
    if (!b->enabled) continue;
    nearColliders.eachNear(b->swept, [&](const Collider&) { near = true; });
    nearBodies.eachNear(b->swept, [&](const RigidBody& o) { near = near || &o != b; });
  }
  return near;
}

/// The broad phase learns what everybody sweeps from tau to the end of the window.
void World::Core::sweepActive(double tau) {
  // Who rests sweeps what it did before. Sorting all anew pays if many move.
  const bool many = active.size() * active.size() > 16 * bodies.size();
  for (RigidBody* b : active) {
    if (!many) nearBodies.remove(*b);
    if (b->enabled) sweep(*b, tau);
  }
  if (many || nearBodies.crowded()) fileBodies();
}

/// All clocks go by a new window.
void World::Core::beginWindow(Nanoseconds at) {
  time_.openWindow(at, nextWindow());
  looks = {};
  queue_.clear();
  const Instant start{time_.origin(), 0};
  const double from = std::max(0.0, time_.from());
  for (RigidBody& b : bodies) {
    b.age0 = start.since(b.since);
    b.until = b.validAge - b.age0;
    b.held.begin = time_.from(), b.held.rebase(start);
  }
  for (Collider& c : colliders) c.motion.begin = time_.from(), c.motion.rebase(start);
  scheduleDue(from);
  const Command* before = nullptr;
  for (const Command& c : commands) {  // one event for all of the same time
    if (!before || before->when != c.when) postCommand(c);
    before = &c;
  }
}

/// A window begins: everybody is looked at anew.
void World::Core::openWindow(Nanoseconds at) {
  beginWindow(at);
  const double from = std::max(0.0, time_.from());
  if (nearColliders.crowded()) fileColliders();
  sweepActive(from);
  if (time_.window() > WorldTime::kWindow && solidsMayMeet()) {
    if (!anyoneNear()) {
      for (RigidBody* b : active) b->alone = true, b->only = 0, awaitHorizon(*b);
      return;
    }
    time_.shortenWindow();
    sweepActive(from);
  }
  for (RigidBody* b : active) mark(*b);
  sortMarked();
  foreseeMarked(from);
}

}  // namespace stadion
