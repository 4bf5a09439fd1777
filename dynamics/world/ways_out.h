#pragma once
/// Leads bodies out of what a hand has put them into, the way they went in.

#include "dynamics/contact/way_out.h"
#include "dynamics/state/field_set.h"
#include "dynamics/state/held_bodies.h"
#include "dynamics/state/swept_boxes.h"

#include <vector>

namespace stadion {

/// Whether the body is on a way out of the collider.
bool comesOutOf(const RigidBody& b, ColliderId id);
/// Drops the ways out that the body has completed.
void forgetWaysOut(RigidBody& b, const WorldObjects& objects, double tau);

class WaysOut {
public:
  WaysOut(const WorldTime& time, const WorldObjects& objects, const FieldSet& fields, const SweptBoxes& boxes,
          const HeldBodies& held)
      : time_(time), objects_(objects), fields_(fields), boxes_(boxes), held_(held) {}

  /// Notes where held bodies are free: in nothing, and not through anything since the last free place.
  void noteFreePlaces();
  /// A body that was released inside something gets its ways out.
  void find(RigidBody& b);
  /// Hash of free places and ways out: part of the simulated state.
  std::uint64_t digest() const;

  template <class Fields>
  void state(Fields& f) {
    f("coming out", comingOut_);
  }

private:
  const WorldTime& time_;
  const WorldObjects& objects_;
  const FieldSet& fields_;
  const SweptBoxes& boxes_;
  const HeldBodies& held_;
  std::vector<BodyId> comingOut_;  ///< bodies with ways out, in the order of their release
};

}  // namespace stadion
