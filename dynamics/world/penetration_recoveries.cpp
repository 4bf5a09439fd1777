#include "dynamics/world/penetration_recoveries.h"

#include "engine/core/state_hash.h"

#include <algorithm>

namespace stadion {

bool comesOutOf(const RigidBody& b, ColliderId id) {
  return std::ranges::any_of(b.grip.recoveries, [&](const PenetrationRecovery& w) { return w.of == id; });
}

/// Forgets the recoveries from colliders that the body has left.
void forgetRecoveries(RigidBody& b, const WorldObjects& objects, double tau) {
  std::erase_if(b.grip.recoveries, [&](const PenetrationRecovery& w) {
    const Collider* c = objects.collider(w.of);
    return !c || !c->enabled || !barrier(Side::of(b), Side::of(*c), tau, w);
  });
}

/// Where held bodies were free last: they overlapped no collider, and have crossed none since.
void PenetrationRecoveries::noteFreePlaces() {
  for (RigidBody* b : held_.list()) {
    if (b->mode != BodyMode::Held) continue;
    const Side self = Side::of(*b);
    const Vec3 middle = b->poseAt(time_.partEnd()) * b->bound.centre;
    Aabb box;
    box.include(middle);
    box.include(b->grip.freePlace);
    box.lo.array() -= b->bound.radius;
    box.hi.array() += b->bound.radius;
    bool free = true;
    boxes_.eachCollider(box, [&](const Collider& c) {
      const Side collider = Side::of(c);
      if (!free || !c.enabled || !objects_.mayTouch(self, collider)) return;
      free = !overlaps(self, collider, time_.partEnd()) &&
             !wentInto(collider, time_.partEnd(), b->grip.freePlace, middle);
    });
    if (free) b->grip.freePlace = middle;
  }
}

/// A body that a hand let go inside a collider returns the way it came.
void PenetrationRecoveries::find(RigidBody& b) {
  b.grip.recoveries.clear();
  if (!b.grip.letGo) return;
  b.grip.letGo = false;
  const double tau = time_.partStart();
  const Kinematics k = b.at(tau);
  if (fields_.accelerationAt(b, k.p, k.v, tau).isZero(0)) return;
  const Side self = Side::of(b);
  Aabb box;
  box.include(k.pose * b.bound.centre);
  box.include(b.grip.freePlace);
  box.lo.array() -= b.bound.radius;
  box.hi.array() += b.bound.radius;
  boxes_.eachCollider(box, [&](const Collider& c) {
    const Side collider = Side::of(c);
    if (!c.enabled || !objects_.mayTouch(self, collider)) return;
    if (const auto recovery = penetrationRecoveryOf(self, collider, tau, b.grip.freePlace))
      b.grip.recoveries.push_back(*recovery);
  });
  std::erase_if(recovering_, [&](BodyId id) {
    return id == b.id || !objects_.body(id) || objects_.body(id)->grip.recoveries.empty();
  });
  if (!b.grip.recoveries.empty()) recovering_.push_back(b.id);
}

std::uint64_t PenetrationRecoveries::digest() const {
  StateHash h;
  for (const RigidBody* b : held_.list())
    if (b->mode == BodyMode::Held) {
      h.add(std::uint64_t{b->id});
      h.add(b->grip.freePlace);
    }
  for (const BodyId id : recovering_) {
    const RigidBody* b = objects_.body(id);
    for (const PenetrationRecovery& w : b ? b->grip.recoveries : std::vector<PenetrationRecovery>{}) {
      h.add(std::uint64_t{id});
      h.add(std::uint64_t{w.of});
      h.add(w.normal);
      h.add(w.side);
    }
  }
  return h.value();
}

}  // namespace stadion
