#include "dynamics/manifold.h"
#include "dynamics/world_core.h"

#include <algorithm>
#include <cmath>

namespace stadion {
namespace {

constexpr double kTouching = 1e-4;         ///< pairs closer than this are in contact [m]
constexpr double kSlop = 1e-5;             ///< overlap that is left alone [m]
constexpr double kPushOut = 0.2;           ///< speed limit of the correction of deeper overlap [m/s]
constexpr double kRestitutionSpeed = 0.1;  ///< slower approaches inside lasting contact do not bounce [m/s]
constexpr double kQuietSpeed = 2e-3;       ///< of surface points [m/s]
constexpr double kQuietTime = 0.2;         ///< before a set of bodies sleeps [s]

std::uint64_t pairKey(Party a, Party b, std::uint32_t feature) {
  std::uint64_t h = 1469598103934665603ULL;
  for (const std::uint64_t x : {std::uint64_t{a.isBody}, std::uint64_t{a.id}, std::uint64_t{b.isBody},
                                std::uint64_t{b.id}, std::uint64_t{feature}})
    h = (h ^ x) * 1099511628211ULL;
  return h;
}

/// Groups bodies that touch, by the smallest index (union-find).
struct Groups {
  std::vector<std::size_t> parent;
  explicit Groups(std::size_t n) : parent(n) {
    for (std::size_t i = 0; i < n; ++i) parent[i] = i;
  }
  std::size_t of(std::size_t i) {
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
  }
  void join(std::size_t a, std::size_t b) {
    a = of(a), b = of(b);
    parent[std::max(a, b)] = std::min(a, b);
  }
};

}  // namespace

void World::Core::enterContact(RigidBody& b, double tau) {
  if (b.mode == BodyMode::Contact || !b.movable()) return;
  const Vec3 L = b.spin.angularMomentum(b.spinAge(tau));
  b.support.on = {};
  setArc(b, tau, Path::parabola(b.position(tau), b.velocity(tau), Vec3::Zero()),
         Spin::free(b.orientation(tau), L, b.inertia), kTick, BodyMode::Contact);
  b.endL = L;
  b.quiet = 0;
  scheduleTick(tau);
}

/// Sleepers that lean on a waking one wake with it.
void World::Core::wake(RigidBody& b, double tau) {
  if (b.mode != BodyMode::Rest) return;
  if (b.support.on.id) {
    restart(b, tau);
    if (b.mode == BodyMode::Rest) return;
  } else {
    enterContact(b, tau);
  }
  wakeOnto({true, b.id}, tau);
}

void World::Core::wakeOnto(Party moved, double tau) {
  for (RigidBody& other : bodies) {
    if (other.mode == BodyMode::Rest || other.mode == BodyMode::Slide || other.mode == BodyMode::Roll) {
      if (other.support.on.id && other.support.on == moved) {
        startFlight(other, tau, other.position(tau), other.velocity(tau), other.orientation(tau),
                    other.spin.angularMomentum(other.spinAge(tau)));
        predict(other, tau);
        continue;
      }
    }
    if (other.mode == BodyMode::Rest &&
        std::find(other.touching.begin(), other.touching.end(), moved) != other.touching.end()) {
      enterContact(other, tau);
      wakeOnto({true, other.id}, tau);
    }
  }
}

void World::Core::scheduleTick(double tau) {
  if (tickAt >= 0 && tickAt <= tau) return;
  ++tickNumber;
  tickAt = tau;
  Event e;
  e.tau = tau, e.kind = Event::Kind::Tick, e.detail = tickNumber;
  post(e);
}

void World::Core::findContacts(RigidBody& b, double tau, std::vector<Found>& found, double h) {
  const Side self = Side::of(b);
  const Kinematics k = b.at(tau);
  const double margin = kTouching + 1.5 * h * (k.v.norm() + k.omega.norm() * b.reach + 9.81 * h);
  Aabb box;
  box.include(k.pose * b.bound.centre);
  box.lo.array() -= b.bound.radius + margin, box.hi.array() += b.bound.radius + margin;
  std::vector<ManifoldPoint> points;
  const auto against = [&](const Side& other) {
    manifold(self, other, tau, margin, points);
    for (const ManifoldPoint& p : points) {
      Found f;
      f.a = self.party, f.b = other.party;
      f.surface = combine(b.surface, surfaceOf(other.party));
      f.gap = p.gap;
      f.key = pairKey(f.a, f.b, p.key);
      f.contact.x = p.gap.point, f.contact.n = p.gap.normal, f.contact.gap = p.gap.distance;
      f.contact.friction = f.surface.friction, f.contact.restitution = f.surface.restitution;
      found.push_back(f);
    }
  };
  nearColliders.eachNear(box, [&](const Collider& c) {
    if (mayTouch(self, Side::of(c))) against(Side::of(c));
  });
  nearBodies.eachNear(box, [&](RigidBody& o) {
    const bool asleep =
        o.mode == BodyMode::Rest || o.mode == BodyMode::Quarantined || o.mode == BodyMode::Held;
    if (&o == &b || !o.enabled || (o.mode == BodyMode::Contact && o.id < b.id)) return;
    const Side other = Side::of(o);
    if (!mayTouch(self, other)) return;
    const double reach = b.bound.radius + o.bound.radius + margin;
    if ((o.at(tau).pose * o.bound.centre - k.pose * b.bound.centre).squaredNorm() > reach * reach) return;
    if (!asleep && o.mode != BodyMode::Contact) return;  // a flier: its touch is an event
    against(other);
  });
}

bool World::Core::solveTick(std::vector<RigidBody*>& set, std::vector<Found>& found, double tau, double h) {
  // Sleepers touched by something that moves wake and join at the next step, which is now.
  for (const Found& f : found) {
    if (!f.b.isBody) continue;
    RigidBody& o = *body(f.b.id);
    const RigidBody& mover = *body(f.a.id);
    if (o.mode != BodyMode::Rest || f.gap.distance > kTouching) continue;
    const Mobile m = mobileOf(mover, tau);
    if (m.velocityAt(f.gap.point).norm() > 5e-3 || mover.quiet == 0) {
      if (o.support.on.id) {
        enterContact(o, tau);
        wakeOnto({true, o.id}, tau);
      } else {
        wake(o, tau);
      }
      if (o.mode == BodyMode::Contact) return false;
    }
  }
  std::vector<Mobile> before, mobiles;
  std::map<Party, std::uint32_t> index;
  for (RigidBody* b : set) {
    Mobile m = mobileOf(*b, tau);
    const Quat q = b->orientation(tau);
    m.omega = q * b->inertia.cwiseInverse().cwiseProduct(q.conjugate() * b->endL);
    index[{true, b->id}] = static_cast<std::uint32_t>(mobiles.size());
    mobiles.push_back(m);
  }
  for (const Found& f : found) {
    if (index.count(f.b)) continue;
    index[f.b] = static_cast<std::uint32_t>(mobiles.size());
    Mobile m = f.b.isBody ? mobileOf(*body(f.b.id), tau) : mobileOf(*collider(f.b.id), tau);
    m.inverseMass = 0, m.inverseInertia.setZero();
    mobiles.push_back(m);
  }
  // First what is an impact: approaches that end now, with restitution if they are fast.
  std::vector<SolverContact> hits;
  for (Found& f : found) {
    f.contact.a = index[f.a], f.contact.b = index[f.b];
    if (f.gap.distance > kSlop) continue;
    SolverContact c = f.contact;
    const double closing = -(mobiles[c.a].velocityAt(c.x) - mobiles[c.b].velocityAt(c.x)).dot(c.n);
    c.floor = closing > kRestitutionSpeed ? c.restitution * closing : 0;
    hits.push_back(c);
  }
  std::vector<Mobile> start = mobiles;
  solveContacts(start, hits);
  // Then the forces of the step: constant through it, so that the arcs are parabolas.
  mobiles = start;
  for (std::size_t i = 0; i < set.size(); ++i) {
    mobiles[i].v += h * accelerationAt(*set[i], mobiles[i].p, mobiles[i].v, tau);
    if (set[i]->damping > 0) mobiles[i].v *= det::exp(-set[i]->damping * h);
  }
  std::vector<SolverContact> step;
  for (Found& f : found) {
    SolverContact c = f.contact;
    const double u = (start[c.a].velocityAt(c.x) - start[c.b].velocityAt(c.x)).dot(c.n);
    if (c.gap > kSlop) {
      c.floor = -2 * c.gap / h - u;  // the mean velocity of the step closes the gap and no more
    } else {
      c.floor = std::min(kPushOut, std::max(0.0, -c.gap - kSlop) * 20);
    }
    if (const auto w = warm.find(f.key); w != warm.end()) {
      c.normalImpulse = w->second.first * h;
      c.frictionImpulse = (w->second.second - c.n * c.n.dot(w->second.second)) * h;
    }
    step.push_back(c);
  }
  solveContacts(mobiles, step);
  for (std::size_t i = 0; i < found.size(); ++i) {
    found[i].contact = step[i];
    // Rolling resistance takes spin of balls up to c r N.
    RigidBody& b = *body(found[i].a.id);
    if (!b.isBall() || step[i].normalImpulse <= 0 || found[i].surface.rolling <= 0) continue;
    Mobile& m = mobiles[step[i].a];
    const double most = found[i].surface.rolling * b.radius() * step[i].normalImpulse / b.inertia.x();
    const double w = m.omega.norm();
    if (w > 0) m.omega *= std::max(0.0, 1 - most / w);
  }
  for (std::size_t i = 0; i < set.size(); ++i) {
    bool touches = false;
    set[i]->touching.clear();
    for (const Found& f : found) {
      const bool mine = f.contact.a == i || f.contact.b == i;
      if (!mine) continue;
      touches = true;
      const Party other = f.contact.a == i ? f.b : f.a;
      if (std::find(set[i]->touching.begin(), set[i]->touching.end(), other) == set[i]->touching.end())
        set[i]->touching.push_back(other);
    }
    concludeTick(*set[i], start[i], mobiles[i], touches, tau, h);
  }
  return true;
}

/// The body's arc to the next step. With nothing near, it flies.
void World::Core::concludeTick(RigidBody& b, const Mobile& start, const Mobile& end, bool touches, double tau,
                               double h) {
  const Quat q = b.orientation(tau);
  const auto momentum = [&](const Mobile& m) {
    return Vec3(q * b.inertia.cwiseProduct(q.conjugate() * m.omega));
  };
  const Vec3 L0 = momentum(start), L1 = momentum(end);
  if (!touches) {
    wakeOnto({true, b.id}, tau);
    startFlight(b, tau, start.p, start.v, q, L0);
    return;
  }
  const double fastest =
      std::max(end.v.norm() + end.omega.norm() * b.reach, start.v.norm() + start.omega.norm() * b.reach);
  b.quiet = fastest < kQuietSpeed ? b.quiet + h : 0;
  setArc(b, tau, Path::parabola(start.p, start.v, (end.v - start.v) / h),
         Spin::free(q, 0.5 * (L0 + L1), b.inertia), h, BodyMode::Contact);
  b.endL = L1;
}

void World::Core::tick(double tau) {
  ++counters.contactSteps;
  tickAt = -1;
  const Nanoseconds next = (timeAt(tau) / kTickGrid + 1) * kTickGrid;
  const double h = Instant{next, 0}.since(instantAt(tau));
  std::vector<RigidBody*> set;
  std::vector<Found> found;
  for (int pass = 0; pass < 50; ++pass) {
    set.clear(), found.clear();
    for (RigidBody* b : active)
      if (b->mode == BodyMode::Contact && b->enabled) set.push_back(b);
    std::ranges::sort(set, {}, &RigidBody::id);
    if (set.empty()) return;
    for (RigidBody* b : set) findContacts(*b, tau, found, h);
    if (solveTick(set, found, tau, h)) break;
  }
  warm.clear();
  for (const Found& f : found) warm[f.key] = {f.contact.normalImpulse / h, f.contact.frictionImpulse / h};
  // Pairs in contact are remembered; those no longer near are free to hit again.
  std::set<ContactMemory::Key> near;
  for (const Found& f : found)
    if (f.gap.distance < kTouching) near.insert(ContactMemory::keyOf(f.a, f.b));
  std::vector<ContactMemory::Key> gone;
  for (const auto& [key, m] : memory.all()) {
    const RigidBody* b = body(key.second);
    const RigidBody* o = key.first.isBody ? body(key.first.id) : nullptr;
    const bool ours = (b && b->mode == BodyMode::Contact) || (o && o->mode == BodyMode::Contact);
    if (m.touching && ours && !near.count(key)) gone.push_back(key);
  }
  for (const auto& key : gone) memory.setTouching(key, false);
  for (const auto& key : near) memory.setTouching(key, true);
  // Balls on one still face have a closed form.
  for (RigidBody* b : set) {
    if (b->mode != BodyMode::Contact || !b->isBall() || b->touching.size() != 1 || b->touching[0].isBody)
      continue;
    const Collider* c = collider(b->touching[0].id);
    const Found* only = nullptr;
    int count = 0;
    for (const Found& f : found)
      if (f.a == Party{true, b->id}) only = &f, ++count;
    Support face;
    const double away = only ? b->velocity(tau).dot(only->gap.normal) : 1;
    if (count != 1 || only->gap.distance > kSlop || std::fabs(away) > 1e-3 ||
        !supportFor(*b, *c, only->gap, tau, face))
      continue;
    b->support = face;
    BallStart s{b->position(tau), b->velocity(tau), b->spin.angularVelocity(b->spinAge(tau)),
                b->orientation(tau)};
    s.v -= face.normal * face.normal.dot(s.v);
    startOnFace(*b, tau, s, false, false);
  }
  // Sets that have been quiet together fall asleep together.
  Groups groups(set.size());
  std::map<BodyId, std::size_t> place;
  for (std::size_t i = 0; i < set.size(); ++i) place[set[i]->id] = i;
  for (const Found& f : found)
    if (f.b.isBody && place.count(f.b.id) && body(f.b.id)->mode == BodyMode::Contact)
      groups.join(place[f.a.id], place[f.b.id]);
  std::vector<bool> restless(set.size(), false);
  for (std::size_t i = 0; i < set.size(); ++i)
    if (set[i]->mode != BodyMode::Contact || set[i]->quiet < kQuietTime) restless[groups.of(i)] = true;
  for (const Found& f : found)
    if (!f.b.isBody && collider(f.b.id)->motion.moving) restless[groups.of(place[f.a.id])] = true;
  bool awake = false;
  for (std::size_t i = 0; i < set.size(); ++i) {
    if (set[i]->mode == BodyMode::Contact && !restless[groups.of(i)]) freeze(*set[i], tau);
    awake = awake || set[i]->mode == BodyMode::Contact;
  }
  for (RigidBody* b : set) predict(*b, tau);
  if (awake) scheduleTick(tauOf(next));
}

}  // namespace stadion
