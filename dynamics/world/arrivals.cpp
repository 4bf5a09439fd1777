#include "dynamics/world/arrivals.h"

#include "dynamics/world/ball_support.h"

#include <algorithm>

namespace stadion {
namespace {

constexpr double kTouchesAtLoad = 1e-5;  ///< nearer than this when they appear, a pair is in contact [m]

}  // namespace

void Arrivals::placeAll() {
  const std::vector<ContactSide> arrived = arrivals();
  placeFresh(arrived);
  if (active_.size() < objects_.bodies().size())  // some body sleeps
    for (const ContactSide p : arrived) wakeWithin(p);
}

/// What has appeared or jumped since the last frame: colliders, then bodies.
std::vector<ContactSide> Arrivals::arrivals() const {
  std::vector<ContactSide> arrived;
  for (const ColliderId id : changes_.colliders())
    if (const Collider* c = objects_.collider(id); c && c->enabled && (c->fresh || c->disturbed))
      arrived.push_back({false, id});
  for (const RigidBody* b : changes_.bodies())
    if (b->enabled && b->fresh) arrived.push_back({true, b->id});
  return arrived;
}

/// Sleepers that something has been put into wake.
void Arrivals::wakeWithin(ContactSide arrived) {
  const Side self = *objects_.side(arrived);
  std::vector<RigidBody*> woken;
  boxes_.eachBody(self.body ? self.body->swept : self.collider->swept, [&](RigidBody& o) {
    if (o.mode != BodyMode::Rest || !o.enabled || &o == self.body || !objects_.mayTouch(Side::of(o), self))
      return;
    if (gapBetween(Side::of(o), self, time_.partStart(), {0.01}).distance < -kTouchesAtLoad)
      woken.push_back(&o);
  });
  for (RigidBody* o : woken) {
    waking_.enterContact(*o, time_.partStart());
    waking_.wakeOnto({true, o->id}, time_.partStart());
  }
}

/// Pairs that touch when one of them appears are in contact and fire nothing.
void Arrivals::placeFresh(const std::vector<ContactSide>& arrived) {
  struct Arrival {
    RigidBody* body;
    std::vector<std::pair<Side, Gap>> touching;
  };
  std::vector<Arrival> placed;
  const auto look = [&](const Side& self, const Side& other, std::vector<std::pair<Side, Gap>>* touching) {
    if (!objects_.mayTouch(self, other)) return;
    const Gap g = gapBetween(self, other, time_.partStart(), {0.01});
    if (!(g.distance < kTouchesAtLoad)) return;
    memory_.setTouching(ContactMemory::keyOf(self.key, other.key), true);
    if (touching) touching->emplace_back(other, g);
  };
  for (const ContactSide p : arrived) {
    if (Collider* c = p.isBody ? nullptr : objects_.collider(p.id)) {
      if (c->fresh)
        boxes_.eachBody(c->swept, [&](RigidBody& o) {
          if (!o.fresh) look(Side::of(o), Side::of(*c), nullptr);
        });
      c->fresh = false;
      continue;
    }
    RigidBody& b = *objects_.body(p.id);
    placed.push_back({&b, {}});
    auto& touching = placed.back().touching;
    boxes_.eachCollider(b.swept, [&](Collider& c) { look(Side::of(b), Side::of(c), &touching); });
    boxes_.eachBody(b.swept, [&](RigidBody& o) {
      if (&o != &b) look(Side::of(b), Side::of(o), &touching);
    });
  }
  for (const Arrival& s : placed) s.body->fresh = false;
  for (const Arrival& s : placed) {
    recoveries_.find(*s.body);
    for (const PenetrationRecovery& w : s.body->grip.recoveries)
      memory_.setTouching(ContactMemory::keyOf({false, w.of}, {true, s.body->id}), true);
    if (!s.body->grip.recoveries.empty())
      waking_.enterContact(*s.body, time_.partStart());
    else if (!s.touching.empty())
      place(*s.body, s.touching);
  }
}

/// A body that appeared touching these: what it does next.
void Arrivals::place(RigidBody& b, const std::vector<std::pair<Side, Gap>>& touching) {
  if (b.mode != BodyMode::Flight) return;
  const double tau = time_.partStart();
  const Kinematics k = b.at(tau);
  const auto& [other, gap] = touching.front();
  const double away = k.v.dot(gap.normal);
  const bool pressed = fields_.accelerationAt(b, k.p, k.v, tau).dot(gap.normal) < 0;
  Support face;
  if (touching.size() == 1 && other.collider && gap.distance > -1e-4 &&
      supportFor(b, *other.collider, gap, face)) {
    if (away > 1e-9) memory_.setTouching(ContactMemory::keyOf(other.key, {true, b.id}), false);
    if (away > 1e-9 || !pressed) return;  // it leaves by itself
    b.support = face;
    arcs_.startOnFace(b, tau, {k.p, k.v - gap.normal * away, k.omega, b.orientation(tau)}, false, false);
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
      memory_.setTouching(ContactMemory::keyOf(o.key, {true, b.id}), false);
  }
  if (lasting && fields_.accelerationAt(b, k.p, k.v, tau).squaredNorm() > 0) waking_.enterContact(b, tau);
}

}  // namespace stadion
