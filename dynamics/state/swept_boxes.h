#pragma once
/// The broad phase: which bodies and colliders come near each other before the window ends.
///
/// Boxes    hold what a thing sweeps from now to the end of the window, as far as its motion is known.
/// Order    visits are in the order of filing, so they do not depend on addresses.

#include "dynamics/collision/broad_phase.h"
#include "dynamics/state/body_lists.h"
#include "dynamics/state/world_objects.h"
#include "dynamics/state/world_time.h"

namespace stadion {

inline bool holds(const Aabb& outer, const Aabb& inner) {
  return (outer.lo.array() <= inner.lo.array()).all() && (inner.hi.array() <= outer.hi.array()).all();
}

class SweptBoxes {
public:
  SweptBoxes(const WorldTime& time, WorldObjects& objects) : time_(time), objects_(objects) {}

  /// Files where the body goes from tau to the end of the window.
  void sweep(RigidBody& b, double tau);
  void sweep(Collider& c);
  /// Files the changed bodies, by id; sorts again if many boxes have changed.
  void sweep(ChangedMotions& changed);
  /// Files all active bodies at the start of a window.
  void sweep(const ActiveBodies& active, double tau);
  void remove(RigidBody& b) { bodies_.remove(b); }
  void remove(Collider& c) { colliders_.remove(c); }
  void sortBodiesIfCrowded();
  void sortCollidersIfCrowded();

  /// Calls f(body) or f(collider) for all whose box overlaps `box`.
  template <class F>
  void eachBody(const Aabb& box, F f) const {
    bodies_.eachNear(box, f);
  }
  template <class F>
  void eachCollider(const Aabb& box, F f) const {
    colliders_.eachNear(box, f);
  }
  /// Returns true if a moving body sweeps a box that something else is near.
  bool anyNear(const ActiveBodies& active) const;

  template <class Fields>
  void state(Fields& f) {
    bodies_.state(f, [this](BodyId id) { return objects_.body(id); });
    colliders_.state(f, [this](ColliderId id) { return objects_.collider(id); });
  }

private:
  void sortBodies();

  const WorldTime& time_;
  WorldObjects& objects_;
  BroadPhase<RigidBody> bodies_;
  BroadPhase<Collider> colliders_;
};

}  // namespace stadion
