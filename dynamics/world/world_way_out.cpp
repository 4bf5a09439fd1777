#include "dynamics/world/world_core.h"

namespace stadion {

/// Where held bodies have been free last: in nothing, and not through anything since.
void World::Core::noteFreePlaces() {
  for (RigidBody* b : held_.list()) {
    if (b->mode != BodyMode::Held) continue;
    const Side self = Side::of(*b);
    const Vec3 middle = b->poseAt(time_.now()) * b->bound.centre;
    Aabb box;
    box.include(middle), box.include(b->freePlace);
    box.lo.array() -= b->bound.radius, box.hi.array() += b->bound.radius;
    bool free = true;
    boxes_.eachCollider(box, [&](const Collider& c) {
      const Side thing = Side::of(c);
      if (!free || !c.enabled || !objects_.mayTouch(self, thing)) return;
      free = !overlaps(self, thing, time_.now()) && !wentInto(thing, time_.now(), b->freePlace, middle);
    });
    if (free) b->freePlace = middle;
  }
}

/// A body that has been let go inside of something is to come out the way it went in.
void World::Core::findWaysOut(RigidBody& b) {
  b.waysOut.clear();
  if (!b.letGo) return;
  b.letGo = false;
  const double tau = time_.from();
  const Kinematics k = b.at(tau);
  if (fields_.accelerationAt(b, k.p, k.v, tau).isZero(0)) return;
  const Side self = Side::of(b);
  Aabb box;
  box.include(k.pose * b.bound.centre), box.include(b.freePlace);
  box.lo.array() -= b.bound.radius, box.hi.array() += b.bound.radius;
  boxes_.eachCollider(box, [&](const Collider& c) {
    const Side thing = Side::of(c);
    if (!c.enabled || !objects_.mayTouch(self, thing)) return;
    if (const auto way = wayOutOf(self, thing, tau, b.freePlace)) b.waysOut.push_back(*way);
  });
  std::erase_if(comingOut, [&](BodyId id) {
    return id == b.id || !objects_.body(id) || objects_.body(id)->waysOut.empty();
  });
  if (!b.waysOut.empty()) comingOut.push_back(b.id);
}

/// Of the things that a body was let go in, those that it is out of.
void World::Core::forgetWaysOut(RigidBody& b, double tau) const {
  std::erase_if(b.waysOut, [&](const WayOut& w) {
    const Collider* c = objects_.collider(w.of);
    return !c || !c->enabled || !barrier(Side::of(b), Side::of(*c), tau, w);
  });
}

bool World::Core::comesOutOf(const RigidBody& b, ColliderId id) {
  return std::ranges::any_of(b.waysOut, [&](const WayOut& w) { return w.of == id; });
}

}  // namespace stadion
