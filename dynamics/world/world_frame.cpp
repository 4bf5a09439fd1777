#include "dynamics/world/world_core.h"

#include <algorithm>
#include <cmath>

namespace stadion {
namespace {

constexpr double kTouchesAtLoad = 1e-5;  ///< nearer than this when they appear, a pair is in contact [m]
constexpr std::uint64_t kMostEvents =
    3000;  ///< in one frame for each body: a last resort against endless chatter

/// False of what is not a number.
bool inBounds(const Pose& X) {
  return X.p.squaredNorm() <= 1e24 && X.q.squaredNorm() < 2;
}

}  // namespace

/// The first frame begins: arcs made before begin with it. If there are commands, they will change most of
/// them before anybody looks.
void World::Core::start(Nanoseconds at) {
  time_.start(at);
  const Nanoseconds whole = at / WorldTime::kWindow * WorldTime::kWindow,
                    opens = at < whole ? whole - WorldTime::kWindow : whole;
  for (RigidBody& b : objects_.bodies()) b.since = Instant{at, 0};
  commands_.empty() ? openWindow(opens) : beginWindow(opens);
}

/// No list remembers it any more.
void World::Core::forgetBody(RigidBody& b) {
  boxes_.remove(b);
  active_.forget(b);
  changes_.forget(b);
  held_.forget(b);
  traces_.forget(b);
}

void World::Core::restartStirred(double tau) {
  commands_.restartStirred([&](RigidBody& b) { restart(b, tau); });
}

void World::Core::newFrame() {
  time_.nextFrame();
  counters = {};
  memory_.beginFrame();
  changed_.clear();
}

/// All clocks are put forward; a new window begins with them.
void World::Core::pause(Nanoseconds to, bool continues) {
  if (!continues) newFrame();
  const Nanoseconds gap = to - time_.t1();
  traces_.pause(continues);
  if (gap == 0) return;
  for (RigidBody& b : objects_.bodies()) b.since.ns += gap, b.woundTo.ns += gap;
  for (ContactMemory::Waiting& w : memory_.waiting()) w.look += gap, w.seen += gap;
  time_.standUntil(to);
  openWindow(to / WorldTime::kWindow * WorldTime::kWindow);
}

void World::Core::advance(Nanoseconds from, Nanoseconds to, bool continues) {
  time_.beginPart(from, to);
  if (!continues) {
    newFrame();
    if (jerking) turnByFrame();
  }
  traces_.begin(continues);
  beginFrame();
  while (time_.t1() - time_.origin() >= time_.window()) {
    runEvents(time_.windowEnd());
    for (RigidBody* b : active_) catchUp(*b, time_.windowEnd());
    const bool idle = active_.empty() && commands_.empty() && changes_.colliders().empty();
    openWindow(idle ? time_.t1() / WorldTime::kWindow * WorldTime::kWindow : time_.origin() + time_.window());
  }
  runEvents(time_.now());
  endFrame();
}

void World::Core::beginFrame() {
  changes_.setImmediate(false);
  const double seconds = time_.now() - time_.from();
  held_.dropReleased();
  for (RigidBody* b : held_.list()) {
    b->held.set(b->held.start, b->held.end, time_.from(), seconds);
    b->held.way.swap(b->nextWay), b->nextWay.clear();
    b->held.follow({time_.origin(), 0}, time_.from(), time_.now());
    traces_.noteHeld(*b, time_.from());
    b->put = false;
    ++b->version;
    changes_.mark(*b);
  }
  changes_.sortColliders();
  for (const ColliderId id : changes_.colliders())
    if (Collider* c = objects_.collider(id)) {
      c->move(c->now, c->next.value_or(c->now), time_.from(), seconds);
      c->next.reset();
      c->motion.way.swap(c->nextWay), c->nextWay.clear();
      c->motion.follow({time_.origin(), 0}, time_.from(), time_.now());
      ++c->version;
      boxes_.sweep(*c);
    }
  commands_.obey(time_.from());
  commands_.followFields();
  restartStirred(time_.from());
  boxes_.sweep(changes_);  // boxes before predictions, so that these see everybody
  const std::vector<Party> arrived = arrivals();
  settleFresh(arrived);
  if (active_.size() < objects_.bodies().size())  // somebody sleeps
    for (const Party p : arrived) wakeWithin(p);
  for (const RigidBody* b : held_.list())
    if (b->held.moving) wakeOnto({true, b->id}, time_.from());
  for (const ColliderId id : changes_.colliders())
    if (Collider* c = objects_.collider(id); c && c->enabled && (c->motion.moving || c->disturbed)) {
      wakeOnto({false, id}, time_.from());
      c->disturbed = false;
    }
  boxes_.sweep(changes_);
  changes_.setImmediate(true);
  foreseeMarked(time_.from());
}

/// Who has appeared or jumped since the last frame: colliders, then bodies.
std::vector<Party> World::Core::arrivals() const {
  std::vector<Party> arrived;
  for (const ColliderId id : changes_.colliders())
    if (const Collider* c = objects_.collider(id); c && c->enabled && (c->fresh || c->disturbed))
      arrived.push_back({false, id});
  for (const RigidBody* b : changes_.bodies())
    if (b->enabled && b->fresh) arrived.push_back({true, b->id});
  return arrived;
}

/// Sleepers that something has been put into wake.
void World::Core::wakeWithin(Party arrived) {
  const Side self = *objects_.side(arrived);
  std::vector<RigidBody*> woken;
  boxes_.eachBody(self.body ? self.body->swept : self.collider->swept, [&](RigidBody& o) {
    if (o.mode != BodyMode::Rest || !o.enabled || &o == self.body || !objects_.mayTouch(Side::of(o), self))
      return;
    if (gapBetween(Side::of(o), self, time_.from(), {0.01}).distance < -kTouchesAtLoad) woken.push_back(&o);
  });
  for (RigidBody* o : woken) {
    enterContact(*o, time_.from());
    wakeOnto({true, o->id}, time_.from());
  }
}

/// Pairs that touch when one of them appears are in contact and fire nothing.
void World::Core::settleFresh(const std::vector<Party>& arrived) {
  struct Settler {
    RigidBody* body;
    std::vector<std::pair<Side, Gap>> touching;
  };
  std::vector<Settler> settlers;
  const auto look = [&](const Side& self, const Side& other, std::vector<std::pair<Side, Gap>>* touching) {
    if (!objects_.mayTouch(self, other)) return;
    const Gap g = gapBetween(self, other, time_.from(), {0.01});
    if (!(g.distance < kTouchesAtLoad)) return;
    memory_.setTouching(ContactMemory::keyOf(self.party, other.party), true);
    if (touching) touching->emplace_back(other, g);
  };
  for (const Party p : arrived) {
    if (Collider* c = p.isBody ? nullptr : objects_.collider(p.id)) {
      if (c->fresh)
        boxes_.eachBody(c->swept, [&](RigidBody& o) {
          if (!o.fresh) look(Side::of(o), Side::of(*c), nullptr);
        });
      c->fresh = false;
      continue;
    }
    RigidBody& b = *objects_.body(p.id);
    settlers.push_back({&b, {}});
    auto& touching = settlers.back().touching;
    boxes_.eachCollider(b.swept, [&](Collider& c) { look(Side::of(b), Side::of(c), &touching); });
    boxes_.eachBody(b.swept, [&](RigidBody& o) {
      if (&o != &b) look(Side::of(b), Side::of(o), &touching);
    });
  }
  for (const Settler& s : settlers) s.body->fresh = false;
  for (const Settler& s : settlers) {
    findWaysOut(*s.body);
    for (const WayOut& w : s.body->waysOut)
      memory_.setTouching(ContactMemory::keyOf({false, w.of}, {true, s.body->id}), true);
    if (!s.body->waysOut.empty())
      enterContact(*s.body, time_.from());
    else if (!s.touching.empty())
      settle(*s.body, s.touching);
  }
}

/// A body that appeared touching these: what it does next.
void World::Core::settle(RigidBody& b, const std::vector<std::pair<Side, Gap>>& touching) {
  if (b.mode != BodyMode::Flight) return;
  const double tau = time_.from();
  const Kinematics k = b.at(tau);
  const auto& [other, gap] = touching.front();
  const double away = k.v.dot(gap.normal);
  const bool pressed = fields_.accelerationAt(b, k.p, k.v, tau).dot(gap.normal) < 0;
  Support face;
  if (touching.size() == 1 && other.collider && gap.distance > -1e-4 &&
      supportFor(b, *other.collider, gap, face)) {
    if (away > 1e-9) memory_.setTouching(ContactMemory::keyOf(other.party, {true, b.id}), false);
    if (away > 1e-9 || !pressed) return;  // it leaves by itself
    b.support = face;
    startOnFace(b, tau, {k.p, k.v - gap.normal * away, k.omega, b.orientation(tau)}, false, false);
    return;
  }
  bool lasting = false;
  for (const auto& [o, g] : touching) {
    const Vec3 u = k.velocityAt(g.point) - o.at(tau).velocityAt(g.point);
    const bool carried = o.collider || o.body->mode != BodyMode::Flight;
    if (u.dot(g.normal) < 1e-3 &&
        (carried || g.distance < -1e-4 || fields_.accelerationAt(b, k.p, k.v, tau).dot(g.normal) < 0))
      lasting = true;
    else if (u.dot(g.normal) > kImpactSpeed)  // they part, and will meet as if they had never touched
      memory_.setTouching(ContactMemory::keyOf(o.party, {true, b.id}), false);
  }
  if (lasting && fields_.accelerationAt(b, k.p, k.v, tau).squaredNorm() > 0) enterContact(b, tau);
}

void World::Core::runEvents(double until) {
  std::uint64_t done = 0;
  changes_.setImmediate(true);
  while (!queue_.empty()) {
    const EventQueue::Event e = queue_.first();
    if (e.tau > until) break;
    queue_.pop();
    fetchNext();
    if (++done > kMostEvents * (active_.size() + 1)) {
      ++counters.limited;
      break;
    }
    boxes_.sortBodiesIfCrowded();
    switch (e.kind) {
    case EventQueue::Event::Kind::Command: commands_.obey(e.tau), restartStirred(e.tau); break;
    case EventQueue::Event::Kind::Tick:
      if (queue_.isScheduled(e)) tick(e.tau);
      break;
    case EventQueue::Event::Kind::Horizon:
      if (objects_.versionOf(e.a) != e.versionA) break;
      if (Collider* c = e.a.isBody ? nullptr : objects_.collider(e.a.id)) turn(*c, e.tau);
      if (RigidBody* b = e.a.isBody ? objects_.body(e.a.id) : nullptr) reachHorizon(*b, e.tau);
      break;
    case EventQueue::Event::Kind::Touch:
      if (objects_.versionOf(e.a) == e.versionA && objects_.versionOf(e.b) == e.versionB) {
        const Touch t = queue_.touchOf(e);
        onTouch(t, e.a, e.b, e.tau);
      }
      break;
    }
  }
}

/// The body of the event after this one.
void World::Core::fetchNext() const {
  if (!active_.many() || queue_.empty()) return;
  const Party next = queue_.first().a;
  if (const RigidBody* b = next.isBody ? objects_.body(next.id) : nullptr) active_.fetchIfMany(*b);
}

/// The body has left the world, between its arc's start or the frame's, and now.
void World::Core::expel(RigidBody& b) {
  double in = std::max(time_.from(), -b.age0), out = time_.now();
  const bool left = inBounds(b.poseAt(in));
  while (left && out - in > 1e-10) {
    const double middle = 0.5 * (in + out);
    if (!(in < middle && middle < out)) break;
    (inBounds(b.poseAt(middle)) ? in : out) = middle;
  }
  quarantine(b, left ? in : time_.now(),
             left ? "it went beyond all bounds (10^12 m)" : "its pose became undefined");
  if (left) b.pose = b.poseAt(in);
}

/// Where it is at the end of the frame.
void World::Core::sample(RigidBody& b) {
  catchUp(b, time_.now());
  const Pose X = b.poseAt(time_.now());
  if (inBounds(X))
    b.pose = X;
  else
    expel(b);
  if (b.mode == BodyMode::Held) b.held.start = b.held.end, b.held.way.clear();
  changed_.push_back(b.id);
  b.active = !standsStill(b.mode);
}

void World::Core::endFrame() {
  if (!held_.list().empty()) held_.windUp(time_.now()), noteFreePlaces();
  if (!memory_.waiting().empty())
    for (RigidBody* b : active_) catchUp(*b, time_.now());
  held_.endTouches();
  reportReleases();
  if (!std::ranges::is_sorted(memory_.events(), {}, &ContactEvent::time))
    std::ranges::stable_sort(memory_.events(), {}, &ContactEvent::time);
  active_.update([&](RigidBody& b) { sample(b); });
  changes_.setImmediate(false);
  if (!std::ranges::is_sorted(changed_)) std::ranges::sort(changed_);
  changed_.erase(std::unique(changed_.begin(), changed_.end()), changed_.end());
  // A collider that has moved stays in the list, so that the next frame notices that it stands.
  changes_.dropColliders([&](ColliderId id) {
    Collider* c = objects_.collider(id);
    if (c) c->now = c->motion.end, c->motion.way.clear();
    return !c || !c->motion.moving;
  });
}

}  // namespace stadion
