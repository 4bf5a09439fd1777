#include "dynamics/world/world_core.h"

#include <algorithm>
#include <cmath>

namespace stadion {
namespace {

/// Most events in one call of runEvents(), for each active body: a last resort against endless chatter.
constexpr std::uint64_t kMostEvents = 3000;

/// Returns false also if the pose is not a number.
bool inBounds(const Pose& X) {
  return X.p.squaredNorm() <= 1e24 && X.q.squaredNorm() < 2;
}

}  // namespace

/// The first frame begins: arcs made before begin with it. If there are commands, they will change most of
/// them before any result is read.
void World::Core::start(Nanoseconds at) {
  time_.start(at);
  const Nanoseconds whole = at / WorldTime::kWindow * WorldTime::kWindow,
                    opens = at < whole ? whole - WorldTime::kWindow : whole;
  for (RigidBody& b : objects_.bodies()) b.since = Instant{at, 0};
  if (commands_.empty())
    openWindow(opens);
  else
    beginWindow(opens);
}

/// Removes the body from all lists.
void World::Core::forgetBody(RigidBody& b) {
  boxes_.remove(b);
  active_.forget(b);
  changes_.forget(b);
  held_.forget(b);
  traces_.forget(b);
}

void World::Core::restartStirred(double tau) {
  commands_.restartStirred([&](RigidBody& b) { waking_.restart(b, tau); });
}

void World::Core::beginFrame() {
  time_.nextFrame();
  counters_ = {};
  memory_.beginFrame();
  changed_.clear();
}

/// All clocks are put forward; a new window begins with them.
void World::Core::pause(Nanoseconds to, bool continues) {
  if (!continues) beginFrame();
  const Nanoseconds gap = to - time_.t1();
  traces_.pause(continues);
  if (gap == 0) return;
  for (RigidBody& b : objects_.bodies()) {
    b.since.ns += gap;
    b.grip.accumulatedTo.ns += gap;
  }
  for (ContactMemory::Waiting& w : memory_.waiting()) {
    w.look += gap;
    w.seen += gap;
  }
  time_.standUntil(to);
  openWindow(to / WorldTime::kWindow * WorldTime::kWindow);
}

void World::Core::advance(Nanoseconds from, Nanoseconds to, bool continues) {
  time_.beginPart(from, to);
  if (!continues) {
    beginFrame();
    if (turnsByFrame_) turnByFrame();
  }
  traces_.begin(continues);
  beginPart();
  while (time_.t1() - time_.origin() >= time_.window()) {
    runEvents(time_.windowEnd());
    for (RigidBody* b : active_) foresight_.catchUp(*b, time_.windowEnd());
    const bool idle = active_.empty() && commands_.empty() && changes_.colliders().empty();
    openWindow(idle ? time_.t1() / WorldTime::kWindow * WorldTime::kWindow : time_.origin() + time_.window());
  }
  runEvents(time_.partEnd());
  endPart();
}

void World::Core::beginPart() {
  changes_.setImmediate(false);
  const double seconds = time_.partEnd() - time_.partStart();
  held_.dropReleased();
  for (RigidBody* b : held_.list()) {
    b->grip.held.set(b->grip.held.start, b->grip.held.end, time_.partStart(), seconds);
    b->grip.held.arcs.swap(b->grip.nextArcs);
    b->grip.nextArcs.clear();
    b->grip.held.follow({time_.origin(), 0}, time_.partStart(), time_.partEnd());
    traces_.noteHeld(*b, time_.partStart());
    b->trace.put = false;
    ++b->version;
    changes_.mark(*b);
  }
  changes_.sortColliders();
  for (const ColliderId id : changes_.colliders())
    if (Collider* c = objects_.collider(id)) {
      c->move(c->now, c->next.value_or(c->now), time_.partStart(), seconds);
      c->next.reset();
      c->motion.arcs.swap(c->nextArcs);
      c->nextArcs.clear();
      c->motion.follow({time_.origin(), 0}, time_.partStart(), time_.partEnd());
      ++c->version;
      boxes_.sweep(*c);
    }
  commands_.apply(time_.partStart());
  commands_.followFields();
  restartStirred(time_.partStart());
  boxes_.sweep(changes_);  // boxes before predictions, so that these see all bodies
  arrivals_.placeAll();
  for (const RigidBody* b : held_.list())
    if (b->grip.held.moving) waking_.wakeOnto({true, b->id}, time_.partStart());
  for (const ColliderId id : changes_.colliders())
    if (Collider* c = objects_.collider(id); c && c->enabled && (c->motion.moving || c->disturbed)) {
      waking_.wakeOnto({false, id}, time_.partStart());
      c->disturbed = false;
    }
  boxes_.sweep(changes_);
  changes_.setImmediate(true);
  foresight_.predictChanged(time_.partStart());
}

void World::Core::runEvents(double until) {
  std::uint64_t done = 0;
  changes_.setImmediate(true);
  while (!queue_.empty()) {
    const EventQueue::Event e = queue_.first();
    if (e.tau > until) break;
    if (++done > kMostEvents * (active_.size() + 1)) {
      ++counters_.limited;
      break;
    }
    queue_.pop();
    fetchNext();
    boxes_.sortBodiesIfCrowded();
    switch (e.kind) {
    case EventQueue::Event::Kind::Command:
      commands_.apply(e.tau);
      restartStirred(e.tau);
      break;
    case EventQueue::Event::Kind::Tick:
      if (queue_.isScheduled(e)) islands_.tick(e.tau);
      break;
    case EventQueue::Event::Kind::Horizon:
      if (objects_.versionOf(e.a) != e.versionA) break;
      if (Collider* c = e.a.isBody ? nullptr : objects_.collider(e.a.id)) ends_.reachHorizon(*c, e.tau);
      if (RigidBody* b = e.a.isBody ? objects_.body(e.a.id) : nullptr) ends_.reachHorizon(*b, e.tau);
      break;
    case EventQueue::Event::Kind::Touch:
      if (objects_.versionOf(e.a) == e.versionA && objects_.versionOf(e.b) == e.versionB) {
        const Touch t = queue_.touchOf(e);
        impacts_.onTouch(t, e.a, e.b, e.tau);
      }
      break;
    }
  }
}

/// Fetches the body of the event after this one into the cache.
void World::Core::fetchNext() const {
  if (!active_.many() || queue_.empty()) return;
  const ContactSide next = queue_.first().a;
  if (const RigidBody* b = next.isBody ? objects_.body(next.id) : nullptr) active_.fetchIfMany(*b);
}

/// The body has left the world, between its arc's start or the frame's, and now.
void World::Core::expel(RigidBody& b) {
  double in = std::max(time_.partStart(), -b.age0), out = time_.partEnd();
  const bool left = inBounds(b.poseAt(in));
  while (left && out - in > 1e-10) {
    const double middle = 0.5 * (in + out);
    if (!(in < middle && middle < out)) break;
    (inBounds(b.poseAt(middle)) ? in : out) = middle;
  }
  arcs_.quarantine(b, left ? in : time_.partEnd(),
                   left ? "it went beyond all bounds (10^12 m)" : "its pose became undefined");
  if (left) b.pose = b.poseAt(in);
}

/// Computes the pose of the body at the end of the frame.
void World::Core::sample(RigidBody& b) {
  foresight_.catchUp(b, time_.partEnd());
  const Pose X = b.poseAt(time_.partEnd());
  if (inBounds(X))
    b.pose = X;
  else
    expel(b);
  if (b.mode == BodyMode::Held) {
    b.grip.held.start = b.grip.held.end;
    b.grip.held.arcs.clear();
  }
  changed_.push_back(b.id);
  b.active = !standsStill(b.mode);
}

void World::Core::endPart() {
  if (!held_.list().empty()) {
    held_.accumulate(time_.partEnd());
    recoveries_.noteFreePlaces();
  }
  if (!memory_.waiting().empty())
    for (RigidBody* b : active_) foresight_.catchUp(*b, time_.partEnd());
  held_.endTouches();
  releases_.reportReleases();
  if (!std::ranges::is_sorted(memory_.events(), {}, &ContactEvent::time))
    std::ranges::stable_sort(memory_.events(), {}, &ContactEvent::time);
  active_.update([&](RigidBody& b) { sample(b); });
  changes_.setImmediate(false);
  if (!std::ranges::is_sorted(changed_)) std::ranges::sort(changed_);
  changed_.erase(std::unique(changed_.begin(), changed_.end()), changed_.end());
  // A collider that has moved stays in the list, so that the next frame notices that it stands.
  changes_.dropColliders([&](ColliderId id) {
    Collider* c = objects_.collider(id);
    if (c) {
      c->now = c->motion.end;
      c->motion.arcs.clear();
    }
    return !c || !c->motion.moving;
  });
}

/// All clocks go by a new window.
void World::Core::beginWindow(Nanoseconds at) {
  time_.openWindow(at, foresight_.nextWindow());
  foresight_.beginWindow();
  const Instant start{time_.origin(), 0};
  const double from = std::max(0.0, time_.partStart());
  for (RigidBody& b : objects_.bodies()) {
    b.age0 = start.since(b.since);
    b.until = b.validAge - b.age0;
    b.grip.held.begin = time_.partStart();
    b.grip.held.rebase(start);
  }
  for (Collider& c : objects_.colliders()) {
    c.motion.begin = time_.partStart();
    c.motion.rebase(start);
  }
  waking_.scheduleDue(from);
  commands_.postAll();
}

/// A window begins: the world looks ahead for all active bodies.
void World::Core::openWindow(Nanoseconds at) {
  beginWindow(at);
  foresight_.fillWindow(std::max(0.0, time_.partStart()));
}

void World::Core::turnByFrame() {
  for (RigidBody* b : active_) {
    if (!b->flight || !b->flight->jerks() || b->mode != BodyMode::Flight || !b->enabled) continue;
    foresight_.catchUp(*b, time_.partStart());
    arcs_.turnByBias(*b, time_.partStart());
    changes_.mark(*b);
  }
}

}  // namespace stadion
