#include "dynamics/world_core.h"

#include <algorithm>
#include <cmath>

namespace stadion {
namespace {

constexpr double kTouchesAtLoad = 1e-5;  ///< nearer than this when they appear, a pair is in contact [m]
constexpr std::uint64_t kMostEvents =
    3000;  ///< in one frame for each body: a last resort against endless chatter

bool isHeld(const Side& s) {
  return s.body && s.body->mode == BodyMode::Held;
}

}  // namespace

/// Whether both are moved from outside, so that no impulse can change either.
bool World::Core::bothCarried(const Side& a, const Side& b) {
  return !(a.body && a.body->movable()) && !(b.body && b.body->movable());
}

Nanoseconds World::Core::timeAt(double tau) const {
  return Instant{t0, 0}.plus(tau).rounded();
}

std::uint32_t World::Core::versionOf(Party p) const {
  if (!p.isBody) return 0;
  const RigidBody* b = body(p.id);
  return b ? b->version : 0;
}

/// Whether the two are to collide at all.
bool World::Core::mayTouch(const Side& a, const Side& b) const {
  if (a.body && b.body && !bodiesCollide) return false;
  if (ignored.empty()) return true;
  return !ignored.count(a.party < b.party ? std::pair(a.party, b.party) : std::pair(b.party, a.party));
}

void World::Core::insert(Command c) {
  c.order = nextOrder++;
  const auto later = [](const Command& x, const Command& y) {
    return x.when != y.when ? x.when < y.when : x.order < y.order;
  };
  commands.insert(std::upper_bound(commands.begin(), commands.end(), c, later), c);
}

/// Applies a change of fields at tau and gives the bodies it concerns new arcs.
void World::Core::execute(const Command& c, double tau) {
  const auto renew = [&](auto concerned) {
    for (auto& [id, b] : bodies)
      if (concerned(b) && b.enabled) restart(b, tau);
  };
  const auto feels = [&](const RigidBody& b) {
    return std::any_of(b.hooks.begin(), b.hooks.end(), [&](const Hook& h) { return h.field == c.field; });
  };
  const auto field = fields.find(c.field);
  RigidBody* b = body(c.body);
  switch (c.kind) {
  case Command::Kind::Switch:
  case Command::Kind::Expire:
    if (field == fields.end()) return;
    if (c.kind == Command::Kind::Expire && (c.activation != field->second.activation || !field->second.on))
      return;
    if (c.on) {
      ++field->second.activation;
      if (field->second.field.duration > 0)
        insert({std::max(c.when, t0) + field->second.field.duration, 0, Command::Kind::Expire, c.field, 0,
                false, field->second.activation});
    }
    if (field->second.on == c.on) return;
    field->second.on = c.on;
    renew(feels);
    return;
  case Command::Kind::Hook:
    if (!b || field == fields.end() || feels(*b)) return;
    b->hooks.push_back({c.field});
    break;
  case Command::Kind::Unhook:
    if (!b || !feels(*b)) return;
    std::erase_if(b->hooks, [&](const Hook& h) { return h.field == c.field; });
    break;
  }
  if (field->second.on) restart(*b, tau);
}

void World::Core::pushHorizon(const RigidBody& b) {
  if (!(b.until <= length)) return;
  Event e;
  e.tau = std::max(b.until, 0.0), e.kind = Event::Kind::Horizon, e.a = {true, b.id}, e.versionA = b.version;
  post(e);
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
    if (memory.touching(ContactMemory::keyOf(a.party, b.party))) return;
  }
  ++counters.pairTests;
  // An arc that ends before the frame is only asked up to its end.
  double to = length;
  if (a.body) to = std::min(to, a.body->until);
  if (b.body) to = std::min(to, b.body->until);
  if (!(tau <= to)) return;
  std::uint64_t iterations = 0;
  const auto touch = firstTouch(a, b, tau, to, iterations);
  if (!touch) return;
  Event e;
  e.tau = touch->tau, e.kind = Event::Kind::Touch, e.a = a.party, e.b = b.party;
  e.versionA = versionOf(a.party), e.versionB = versionOf(b.party);
  e.detail = static_cast<std::uint32_t>(touches_.size());
  touches_.push_back(*touch);
  post(e);
}

/// What the body's arc meets from tau to the end of the frame.
void World::Core::predict(RigidBody& b, double tau, bool onlyGreater) {
  if (!b.enabled || !foresee) return;
  const Side self = Side::of(b);
  b.swept = sweptBox(self, tau, std::max(tau, std::min(length, b.until)));
  pushHorizon(b);
  for (auto& [id, c] : colliders)
    if (c.enabled && c.swept.overlaps(b.swept)) predictPair(self, Side::of(c), tau);
  if (!b.strayed && !((b.filed.lo.array() <= b.swept.lo.array()).all() &&
                      (b.swept.hi.array() <= b.filed.hi.array()).all())) {
    b.strayed = true;
    strayed_.push_back(&b);
  }
  eachNear(b.swept, [&](RigidBody& o) {
    if (&o == &b || !o.enabled || (onlyGreater && o.id < b.id)) return;
    predictPair(self, Side::of(o), tau);
  });
}

void World::Core::fileBodies() {
  order_.clear(), strayed_.clear();
  widest_ = 0;
  for (auto& [id, b] : bodies) {
    // Wide enough that a fresh arc of the same motion stays inside.
    b.filed = b.swept;
    b.filed.lo.array() -= 1e-6, b.filed.hi.array() += 1e-6;
    b.strayed = false;
    if (!b.enabled) continue;
    order_.push_back({b.filed.lo.x(), &b});
    widest_ = std::max(widest_, b.filed.hi.x() - b.filed.lo.x());
  }
  std::stable_sort(order_.begin(), order_.end(),
                   [](const Filed& a, const Filed& b) { return a.low < b.low; });
}

void World::Core::advance(Nanoseconds from, Nanoseconds to, bool continues) {
  t0 = from, t1 = to;
  length = toSeconds(to - from);
  started = true;
  if (!continues) {
    ++frame;
    counters = {};
    memory.beginFrame();
  }
  beginFrame();
  runEvents();
  endFrame();
}

void World::Core::standStill() {
  if (length == 0 && t0 == t1 && order_.empty()) return;
  t0 = t1;
  length = 0;
  order_.clear(), strayed_.clear();
  for (auto& [id, b] : bodies) b.age0 = Instant{t0, 0}.since(b.since), b.until = b.validAge - b.age0;
  for (auto& [id, c] : colliders) c.motion.set(c.now, c.now, 0);
}

void World::Core::beginFrame() {
  queue_ = {};
  touches_.clear();
  const Instant start{t0, 0};
  for (auto& [id, b] : bodies) {
    b.age0 = start.since(b.since);
    b.until = b.validAge - b.age0;
    b.impacts = 0;
    if (b.mode == BodyMode::Held) b.held.set(b.held.start, b.held.end, length);
  }
  std::vector<ColliderId> disturbed;
  for (auto& [id, c] : colliders) {
    c.motion.set(c.now, c.next.value_or(c.now), length);
    c.next.reset();
    if (c.motion.moving || c.disturbed) disturbed.push_back(id);
    c.swept = sweptBox(Side::of(c), 0, length);
  }
  tickAt = -1;
  foresee = false;
  // Commands that are due now or were due before, and fields that are not what they were.
  while (!commands.empty() && commands.front().when <= t0) {
    const auto end =
        std::find_if(commands.begin(), commands.end(), [&](const Command& c) { return c.when > t0; });
    const std::vector<Command> due(commands.begin(), end);
    commands.erase(commands.begin(), end);
    for (const Command& c : due) execute(c, 0);
  }
  std::set<FieldId> changed;
  for (auto& [id, f] : fields)
    if (f.changed || f.field.moving()) changed.insert(id);
  for (auto& [id, b] : bodies) {
    const bool concerned = std::any_of(b.hooks.begin(), b.hooks.end(),
                                       [&](const Hook& h) { return changed.count(h.field) > 0; });
    if (concerned) restart(b, 0);
  }
  for (auto& [id, f] : fields) f.changed = f.field.moving();  // once it stops, the next frame differs again
  // Boxes before predictions, so that these see everybody.
  for (auto& [id, b] : bodies) b.swept = sweptBox(Side::of(b), 0, length);
  fileBodies();
  const std::vector<Party> arrived = arrivals();
  settleFresh();
  for (const Party p : arrived) wakeWithin(p);
  for (const ColliderId id : disturbed) {
    wakeOnto({false, id}, 0);
    colliders.at(id).disturbed = false;
  }
  foresee = true;
  for (const Command& c : commands) {
    if (c.when >= t1) break;
    Event e;
    e.tau = toSeconds(c.when - t0), e.kind = Event::Kind::Command;
    post(e);
  }
  bool solving = false;
  for (auto& [id, b] : bodies) {
    predict(b, 0, true);
    solving = solving || b.mode == BodyMode::Contact;
  }
  if (solving) {
    constexpr Nanoseconds grid = 2'000'000;
    scheduleTick(Instant{(t0 + grid - 1) / grid * grid, 0}.since(Instant{t0, 0}));
  }
}

/// Who has appeared or jumped since the last frame.
std::vector<Party> World::Core::arrivals() const {
  std::vector<Party> arrived;
  for (const auto& [id, c] : colliders)
    if (c.enabled && (c.fresh || c.disturbed)) arrived.push_back({false, id});
  for (const auto& [id, b] : bodies)
    if (b.enabled && b.fresh) arrived.push_back({true, id});
  return arrived;
}

/// Sleepers that something has been put into wake.
void World::Core::wakeWithin(Party arrived) {
  const Side self = *side(arrived);
  std::vector<RigidBody*> stirred;
  eachNear(self.body ? self.body->swept : self.collider->swept, [&](RigidBody& o) {
    if (o.mode != BodyMode::Rest || !o.enabled || &o == self.body || !mayTouch(Side::of(o), self)) return;
    if (gapBetween(Side::of(o), self, 0, 0.01).distance < -kTouchesAtLoad) stirred.push_back(&o);
  });
  for (RigidBody* o : stirred) {
    enterContact(*o, 0);
    wakeOnto({true, o->id}, 0);
  }
}

/// Pairs that touch when one of them appears are in contact and fire nothing.
void World::Core::settleFresh() {
  const auto isFresh = [](const auto& entry) { return entry.second.fresh; };
  if (std::none_of(bodies.begin(), bodies.end(), isFresh) &&
      std::none_of(colliders.begin(), colliders.end(), isFresh))
    return;
  std::vector<std::pair<RigidBody*, std::vector<std::pair<Side, Gap>>>> found;
  for (auto& [id, b] : bodies) {
    if (!b.enabled) continue;
    std::vector<std::pair<Side, Gap>> touching;
    const Side self = Side::of(b);
    const auto look = [&](const Side& other, bool otherFresh) {
      if ((!b.fresh && !otherFresh) || !mayTouch(self, other)) return;
      const Gap g = gapBetween(self, other, 0, 0.01);
      if (!(g.distance < kTouchesAtLoad)) return;
      memory.setTouching(ContactMemory::keyOf(self.party, other.party), true);
      touching.emplace_back(other, g);
    };
    for (auto& [cid, c] : colliders)
      if (c.enabled && (b.fresh || c.fresh) && c.swept.overlaps(b.swept)) look(Side::of(c), c.fresh);
    eachNear(b.swept, [&](RigidBody& o) {
      if (&o != &b && o.enabled && (b.fresh || o.fresh)) look(Side::of(o), o.fresh);
    });
    if (b.fresh && !touching.empty()) found.emplace_back(&b, std::move(touching));
  }
  for (auto& [id, b] : bodies) b.fresh = false;
  for (auto& [id, c] : colliders) c.fresh = false;
  for (auto& [b, touching] : found) {
    if (b->mode != BodyMode::Flight) continue;
    const Kinematics k = b->at(0);
    const auto& [other, gap] = touching.front();
    const double away = k.v.dot(gap.normal);
    const bool pressed = accelerationAt(*b, k.p, k.v, 0).dot(gap.normal) < 0;
    Support face;
    if (touching.size() == 1 && other.collider && supportFor(*b, *other.collider, gap, 0, face)) {
      if (away > 1e-9 || !pressed) continue;  // it leaves by itself
      b->support = face;
      startOnFace(*b, 0, {k.p, k.v - gap.normal * away, k.omega, b->orientation(0)}, false, false);
      continue;
    }
    bool lasting = false;
    for (const auto& [o, g] : touching) {
      const Vec3 u = k.velocityAt(g.point) - o.at(0).velocityAt(g.point);
      const bool carried = o.collider || o.body->mode != BodyMode::Flight;
      if (u.dot(g.normal) < 1e-3 &&
          (carried || g.distance < -1e-4 || accelerationAt(*b, k.p, k.v, 0).dot(g.normal) < 0))
        lasting = true;
    }
    if (lasting && accelerationAt(*b, k.p, k.v, 0).squaredNorm() > 0) enterContact(*b, 0);
  }
}

void World::Core::runEvents() {
  std::uint64_t done = 0;
  while (!queue_.empty()) {
    const Event e = queue_.top();
    if (e.tau > length) break;
    queue_.pop();
    if (++done > kMostEvents * (bodies.size() + 1)) {
      ++counters.limited;
      break;
    }
    switch (e.kind) {
    case Event::Kind::Command: {
      if (commands.empty() || commands.front().when >= t1) break;
      const Command c = commands.front();
      commands.erase(commands.begin());
      const std::size_t before = commands.size();
      execute(c, toSeconds(std::max(c.when, t0) - t0));
      if (commands.size() > before) {  // an activation that also ends within this frame
        for (const Command& x : commands) {
          if (x.when >= t1 || x.order + 1 != nextOrder) continue;
          Event end;
          end.tau = toSeconds(x.when - t0), end.kind = Event::Kind::Command;
          post(end);
          break;
        }
      }
      break;
    }
    case Event::Kind::Tick:
      if (e.detail == tickNumber && tickAt >= 0) tick(e.tau);
      break;
    case Event::Kind::Horizon:
      if (RigidBody* b = body(e.a.id); b && b->version == e.versionA) reachHorizon(*b, e.tau);
      break;
    case Event::Kind::Touch:
      if (versionOf(e.a) == e.versionA && versionOf(e.b) == e.versionB) {
        const Touch t = touches_[e.detail];
        onTouch(t, e.a, e.b, e.tau);
      }
      break;
    }
  }
}

void World::Core::endFrame() {
  foresee = false;
  partCarried();
  reportReleases();
  std::stable_sort(memory.events().begin(), memory.events().end(),
                   [](const ContactEvent& a, const ContactEvent& b) { return a.time < b.time; });
  for (auto& [id, b] : bodies) {
    const Pose X = b.at(length).pose;
    if (X.finite() && X.p.cwiseAbs().maxCoeff() <= 1e12) {
      b.pose = X;
    } else {
      quarantine(b, length, "its pose became undefined");
    }
    if (b.mode == BodyMode::Held) b.held.start = b.held.end;
  }
  for (auto& [id, c] : colliders) c.now = c.motion.end;
}

/// Pairs whose impact was told are released when their surfaces are far enough apart, not in the impact's own
/// frame.
void World::Core::reportReleases() {
  std::vector<std::pair<ContactMemory::Key, Nanoseconds>> due;
  for (const auto& [key, m] : memory.all()) {
    if (!m.fired || m.frame == frame) continue;
    const auto a = side(key.first), b = side({true, key.second});
    if (!a || !b) {
      due.emplace_back(key, t1);
      continue;
    }
    const double far = b->body->releaseDistance;
    const auto beyond = [&](double tau) { return gapBetween(*b, *a, tau, far + 1e-3).distance > far; };
    if (!beyond(length)) continue;
    double lo = 0, hi = length;
    if (!beyond(lo)) {
      for (int i = 0; i < 40 && hi - lo > 1e-10; ++i) (beyond(0.5 * (lo + hi)) ? hi : lo) = 0.5 * (lo + hi);
    } else {
      hi = 0;
    }
    due.emplace_back(key, timeAt(hi));
  }
  for (const auto& [key, time] : due) memory.release(key, time);
}

/// Things moved from outside touch until they are apart at the end of a frame.
void World::Core::partCarried() {
  std::vector<ContactMemory::Key> apart;
  for (const auto& [key, m] : memory.all()) {
    if (!m.touching) continue;
    const auto a = side(key.first), b = side({true, key.second});
    if (a && b && bothCarried(*a, *b) && gapBetween(*b, *a, length, 1e-3).distance > 1e-5)
      apart.push_back(key);
  }
  for (const auto& key : apart) memory.setTouching(key, false);
}

}  // namespace stadion
