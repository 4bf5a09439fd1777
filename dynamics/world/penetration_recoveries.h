#pragma once
/// Leads bodies out of colliders into which a hand has put them, by the way on which they went in.
///
/// Threads  one at a time, as the world that it belongs to (world.h).

#include "dynamics/contact/penetration_recovery.h"
#include "dynamics/state/field_set.h"
#include "dynamics/state/held_bodies.h"
#include "dynamics/state/swept_boxes.h"

#include <vector>

namespace stadion {

/// Returns true if the body is recovering from penetration of the collider.
bool comesOutOf(const RigidBody& b, ColliderId id);
/// Drops the recoveries that the body has completed.
void forgetRecoveries(RigidBody& b, const WorldObjects& objects, double tau);

class PenetrationRecoveries {
public:
  PenetrationRecoveries(const WorldTime& time, const WorldObjects& objects, const FieldSet& fields,
                        const SweptBoxes& boxes, const HeldBodies& held)
      : time_(time), objects_(objects), fields_(fields), boxes_(boxes), held_(held) {}

  /// Notes the places where held bodies are free: they overlap nothing, and have passed through nothing since
  /// the last free place.
  void noteFreePlaces();
  /// Finds the recoveries of a body that was released inside a collider.
  void find(RigidBody& b);
  /// Returns a hash of free places and recoveries, which are part of the simulated state.
  std::uint64_t digest() const;

  template <class Fields>
  void state(Fields& f) {
    f("coming out", recovering_);
  }

private:
  const WorldTime& time_;
  const WorldObjects& objects_;
  const FieldSet& fields_;
  const SweptBoxes& boxes_;
  const HeldBodies& held_;
  std::vector<BodyId> recovering_;  ///< bodies with recoveries, in the order of their release
};

}  // namespace stadion
