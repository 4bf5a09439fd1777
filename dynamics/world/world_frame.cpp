#include "dynamics/world/world_core.h"

#include <algorithm>
#include <cmath>

namespace stadion {
namespace {

constexpr double kTouchesAtLoad = 1e-5;  ///< nearer than this when they appear, a pair is in contact [m]
constexpr std::uint64_t kMostEvents =
    3000;  ///< in one frame for each body: a last resort against endless chatter

/// Where more than these move, they do not fit a processor's own cache: who comes next is fetched in time.
constexpr std::size_t kFitInCache = 256;

void fetch(const RigidMotion& b) {
  constexpr std::size_t kLine = 64;
#pragma GCC unroll 64
  for (std::size_t i = 0; i < sizeof b; i += kLine) __builtin_prefetch(reinterpret_cast<const char*>(&b) + i);
}

/// False of what is not a number.
bool inBounds(const Pose& X) {
  return X.p.squaredNorm() <= 1e24 && X.q.squaredNorm() < 2;
}

}  // namespace

void World::Core::insert(Command c) {
  c.order = queue_.takeOrder();
  const auto later = [](const Command& x, const Command& y) {
    return x.when != y.when ? x.when < y.when : x.order < y.order;
  };
  commands.insert(std::upper_bound(commands.begin(), commands.end(), c, later), c);
  postCommand(c);
}

void World::Core::postCommand(const Command& c) {
  if (time_.started() && time_.inWindow(c.when)) queue_.postCommand(time_.tauOf(c.when));
}

/// Something else pulls at the body now: it is to begin a new arc.
void World::Core::stir(RigidBody& b) {
  if (b.stirred || !b.enabled) return;
  b.stirred = true;
  stirred.push_back(&b);
}

/// Whoever has been stirred begins a new arc, once for all that has changed at tau.
void World::Core::restartStirred(double tau) {
  for (RigidBody* b : stirred) {
    b->stirred = false;
    restart(*b, tau);
  }
  stirred.clear();
}

/// What is due up to tau, in its order.
void World::Core::obeyCommands(double tau) {
  while (!commands.empty() && time_.tauOf(commands.front().when) <= tau) {
    const Command c = commands.front();
    commands.pop_front();
    execute(c, tau);
  }
}

/// Applies a change of fields at tau and stirs the bodies it concerns.
void World::Core::execute(const Command& c, double tau) {
  const auto feels = [&](const RigidBody& b) {
    return std::any_of(b.hooks.begin(), b.hooks.end(), [&](const Hook& h) { return h.field == c.field; });
  };
  FieldEntry* field = fields.find(c.field);
  RigidBody* b = body(c.body);
  windUp(tau);
  switch (c.kind) {
  case Command::Kind::Switch:
  case Command::Kind::Expire:
    if (!field) return;
    if (c.kind == Command::Kind::Expire && (c.activation != field->activation || !field->on)) return;
    if (c.on) {
      ++field->activation;
      if (field->field.duration > 0)
        insert({std::max(c.when, time_.timeAt(tau)) + field->field.duration, 0, Command::Kind::Expire,
                c.field, 0, false, field->activation});
    }
    if (field->on == c.on) return;
    field->on = c.on;
    for (RigidBody& o : bodies)
      if (feels(o)) stir(o);
    return;
  case Command::Kind::Hook:
    if (!b || !field || feels(*b)) return;
    if (b->flight && b->flight->inVacuum && std::holds_alternative<MediumField>(field->field.law)) return;
    b->hooks.push_back({c.field});
    break;
  case Command::Kind::Unhook:
    if (!b || !feels(*b)) return;
    std::erase_if(b->hooks, [&](const Hook& h) { return h.field == c.field; });
    break;
  }
  if (field->on) stir(*b);
}

/// The first frame begins: arcs made before begin with it. If there are commands, they will change most of
/// them before anybody looks.
void World::Core::start(Nanoseconds at) {
  time_.start(at);
  const Nanoseconds whole = at / WorldTime::kWindow * WorldTime::kWindow,
                    opens = at < whole ? whole - WorldTime::kWindow : whole;
  for (RigidBody& b : bodies) b.since = Instant{at, 0};
  commands.empty() ? openWindow(opens) : beginWindow(opens);
}

/// No list remembers it any more.
void World::Core::forgetBody(RigidBody& b) {
  nearBodies.remove(b);
  std::erase(active, &b);
  std::erase(marked, &b);
  std::erase(held, &b);
  std::erase(tracedBodies, &b);
}

void World::Core::newFrame() {
  time_.nextFrame();
  counters = {};
  memory.beginFrame();
  changed.clear();
}

/// All clocks are put forward; a new window begins with them.
void World::Core::pause(Nanoseconds to, bool continues) {
  if (!continues) newFrame();
  const Nanoseconds gap = to - time_.t1();
  pauseTraces(continues);
  if (gap == 0) return;
  for (RigidBody& b : bodies) b.since.ns += gap, b.woundTo.ns += gap;
  for (ContactMemory::Waiting& w : memory.waiting()) w.look += gap, w.seen += gap;
  time_.standUntil(to);
  openWindow(to / WorldTime::kWindow * WorldTime::kWindow);
}

void World::Core::advance(Nanoseconds from, Nanoseconds to, bool continues) {
  time_.beginPart(from, to);
  if (!continues) {
    newFrame();
    if (jerking) turnByFrame();
  }
  beginTraces(continues);
  beginFrame();
  while (time_.t1() - time_.origin() >= time_.window()) {
    runEvents(time_.windowEnd());
    for (RigidBody* b : active) catchUp(*b, time_.windowEnd());
    const bool idle = active.empty() && commands.empty() && told.empty();
    openWindow(idle ? time_.t1() / WorldTime::kWindow * WorldTime::kWindow : time_.origin() + time_.window());
  }
  runEvents(time_.now());
  endFrame();
}

void World::Core::beginFrame() {
  foresee = false;
  const double seconds = time_.now() - time_.from();
  std::erase_if(held, [](const RigidBody* b) { return b->mode != BodyMode::Held; });
  for (RigidBody* b : held) {
    b->held.set(b->held.start, b->held.end, time_.from(), seconds);
    b->held.way.swap(b->nextWay), b->nextWay.clear();
    b->held.follow({time_.origin(), 0}, time_.from(), time_.now());
    noteHeld(*b, time_.from());
    b->put = false;
    ++b->version;
    mark(*b);
  }
  std::ranges::sort(told);
  told.erase(std::unique(told.begin(), told.end()), told.end());
  for (const ColliderId id : told)
    if (Collider* c = collider(id)) {
      c->move(c->now, c->next.value_or(c->now), time_.from(), seconds);
      c->next.reset();
      c->motion.way.swap(c->nextWay), c->nextWay.clear();
      c->motion.follow({time_.origin(), 0}, time_.from(), time_.now());
      ++c->version;
      sweep(*c);
    }
  obeyCommands(time_.from());
  followFields();
  restartStirred(time_.from());
  sweepMarked();  // boxes before predictions, so that these see everybody
  const std::vector<Party> arrived = arrivals();
  settleFresh(arrived);
  if (active.size() < bodies.size())  // somebody sleeps
    for (const Party p : arrived) wakeWithin(p);
  for (const RigidBody* b : held)
    if (b->held.moving) wakeOnto({true, b->id}, time_.from());
  for (const ColliderId id : told)
    if (Collider* c = collider(id); c && c->enabled && (c->motion.moving || c->disturbed)) {
      wakeOnto({false, id}, time_.from());
      c->disturbed = false;
    }
  sweepMarked();
  foresee = true;
  foreseeMarked(time_.from());
}

/// Bodies that feel a field which is not what it was, or which moves, are to begin new arcs. One that is off
/// stirs them when it is switched on.
void World::Core::followFields() {
  std::vector<FieldId> different;
  for (FieldEntry& f : fields) {
    if (f.on && (f.changed || f.field.changing())) different.push_back(f.id);
    f.changed = f.field.changing();  // once it stops, the next frame differs again
  }
  if (different.empty()) return;
  for (RigidBody& b : bodies) {
    const bool concerned = std::ranges::any_of(
        b.hooks, [&](const Hook& h) { return std::ranges::find(different, h.field) != different.end(); });
    if (!concerned || !b.enabled) continue;
    // Steps of heaps go on; so do those that end at once, since a frame's parts may be as short.
    if (b.mode == BodyMode::Contact && (b.crowd || b.dueAge - b.age(time_.from()) <= kShortestStep)) continue;
    stir(b);
  }
}

/// Who has appeared or jumped since the last frame: colliders, then bodies.
std::vector<Party> World::Core::arrivals() const {
  std::vector<Party> arrived;
  for (const ColliderId id : told)
    if (const Collider* c = collider(id); c && c->enabled && (c->fresh || c->disturbed))
      arrived.push_back({false, id});
  for (const RigidBody* b : marked)
    if (b->enabled && b->fresh) arrived.push_back({true, b->id});
  return arrived;
}

/// Sleepers that something has been put into wake.
void World::Core::wakeWithin(Party arrived) {
  const Side self = *side(arrived);
  std::vector<RigidBody*> woken;
  nearBodies.eachNear(self.body ? self.body->swept : self.collider->swept, [&](RigidBody& o) {
    if (o.mode != BodyMode::Rest || !o.enabled || &o == self.body || !mayTouch(Side::of(o), self)) return;
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
    if (!mayTouch(self, other)) return;
    const Gap g = gapBetween(self, other, time_.from(), {0.01});
    if (!(g.distance < kTouchesAtLoad)) return;
    memory.setTouching(ContactMemory::keyOf(self.party, other.party), true);
    if (touching) touching->emplace_back(other, g);
  };
  for (const Party p : arrived) {
    if (Collider* c = p.isBody ? nullptr : collider(p.id)) {
      if (c->fresh)
        nearBodies.eachNear(c->swept, [&](RigidBody& o) {
          if (!o.fresh) look(Side::of(o), Side::of(*c), nullptr);
        });
      c->fresh = false;
      continue;
    }
    RigidBody& b = *body(p.id);
    settlers.push_back({&b, {}});
    auto& touching = settlers.back().touching;
    nearColliders.eachNear(b.swept, [&](Collider& c) { look(Side::of(b), Side::of(c), &touching); });
    nearBodies.eachNear(b.swept, [&](RigidBody& o) {
      if (&o != &b) look(Side::of(b), Side::of(o), &touching);
    });
  }
  for (const Settler& s : settlers) s.body->fresh = false;
  for (const Settler& s : settlers) {
    findWaysOut(*s.body);
    for (const WayOut& w : s.body->waysOut)
      memory.setTouching(ContactMemory::keyOf({false, w.of}, {true, s.body->id}), true);
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
  const bool pressed = accelerationAt(b, k.p, k.v, tau).dot(gap.normal) < 0;
  Support face;
  if (touching.size() == 1 && other.collider && gap.distance > -1e-4 &&
      supportFor(b, *other.collider, gap, face)) {
    if (away > 1e-9) memory.setTouching(ContactMemory::keyOf(other.party, {true, b.id}), false);
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
        (carried || g.distance < -1e-4 || accelerationAt(b, k.p, k.v, tau).dot(g.normal) < 0))
      lasting = true;
    else if (u.dot(g.normal) > kImpactSpeed)  // they part, and will meet as if they had never touched
      memory.setTouching(ContactMemory::keyOf(o.party, {true, b.id}), false);
  }
  if (lasting && accelerationAt(b, k.p, k.v, tau).squaredNorm() > 0) enterContact(b, tau);
}

void World::Core::runEvents(double until) {
  std::uint64_t done = 0;
  foresee = true;
  while (!queue_.empty()) {
    const Event e = queue_.first();
    if (e.tau > until) break;
    queue_.pop();
    fetchNext();
    if (++done > kMostEvents * (active.size() + 1)) {
      ++counters.limited;
      break;
    }
    if (nearBodies.crowded()) fileBodies();
    switch (e.kind) {
    case Event::Kind::Command: obeyCommands(e.tau), restartStirred(e.tau); break;
    case Event::Kind::Tick:
      if (queue_.isScheduled(e)) tick(e.tau);
      break;
    case Event::Kind::Horizon:
      if (versionOf(e.a) != e.versionA) break;
      if (Collider* c = e.a.isBody ? nullptr : collider(e.a.id)) turn(*c, e.tau);
      if (RigidBody* b = e.a.isBody ? body(e.a.id) : nullptr) reachHorizon(*b, e.tau);
      break;
    case Event::Kind::Touch:
      if (versionOf(e.a) == e.versionA && versionOf(e.b) == e.versionB) {
        const Touch t = queue_.touchOf(e);
        onTouch(t, e.a, e.b, e.tau);
      }
      break;
    }
  }
}

/// The body of the event after this one.
void World::Core::fetchNext() const {
  if (active.size() <= kFitInCache || queue_.empty()) return;
  const Party next = queue_.first().a;
  if (const RigidBody* b = next.isBody ? body(next.id) : nullptr) fetch(*b);
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
  changed.push_back(b.id);
  b.active = !standsStill(b.mode);
}

/// What carried fields have done to held bodies up to tau adds up. As long as nothing is switched, a push
/// goes evenly and stays the same way in the hand: its mean is that of the middle.
void World::Core::windUp(double tau) {
  for (RigidBody* b : held) {
    if (b->mode != BodyMode::Held || b->carried.empty()) continue;
    const double span = time_.instantAt(tau).since(b->woundTo), middle = tau - 0.5 * span;
    if (!(span > 0)) continue;
    b->woundTo = time_.instantAt(tau);
    const Quat q_NW = b->held.at(middle).pose.q.conjugate();
    for (const FieldId id : b->carried) {
      const FieldEntry* f = fields.find(id);
      const bool hooked = std::ranges::any_of(b->hooks, [&](const Hook& h) { return h.field == id; });
      if (!f || !f->on || !hooked || !std::holds_alternative<LinearField>(f->field.law)) continue;
      b->wound += span * (q_NW * accelerationOf(f->field, {b->mass, b->dragArea}, time_.shareAt(middle)));
    }
  }
}

void World::Core::endFrame() {
  if (!held.empty()) windUp(time_.now()), noteFreePlaces();
  if (!memory.waiting().empty())
    for (RigidBody* b : active) catchUp(*b, time_.now());
  partCarried();
  reportReleases();
  if (!std::ranges::is_sorted(memory.events(), {}, &ContactEvent::time))
    std::ranges::stable_sort(memory.events(), {}, &ContactEvent::time);
  constexpr std::size_t kAhead = 4;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < active.size(); ++i) {
    if (active.size() > kFitInCache && i + kAhead < active.size()) fetch(*active[i + kAhead]);
    RigidBody* b = active[i];
    sample(*b);
    if (b->active) active[kept++] = b;
  }
  active.resize(kept);
  foresee = false;
  if (!std::ranges::is_sorted(changed)) std::ranges::sort(changed);
  changed.erase(std::unique(changed.begin(), changed.end()), changed.end());
  // Who moved is told once more next time that it stands.
  std::erase_if(told, [&](ColliderId id) {
    Collider* c = collider(id);
    if (c) c->now = c->motion.end, c->motion.way.clear();
    return !c || !c->motion.moving;
  });
}

/// Things moved from outside touch until they are apart at the end of a frame.
void World::Core::partCarried() {
  std::vector<ContactMemory::Key> apart;
  const auto look = [&](const ContactMemory::Key& key) {
    if (!memory.touching(key)) return;
    const auto a = side(key.first), b = side({true, key.second});
    if (a && b && bothCarried(*a, *b) && gapBetween(*b, *a, time_.now(), {1e-3}).distance > kCarriedApart)
      apart.push_back(key);
  };
  for (const RigidBody* b : held)
    if (b->mode == BodyMode::Held) memory.eachWith({true, b->id}, look);
  for (const auto& key : apart) memory.setTouching(key, false);
}

}  // namespace stadion
