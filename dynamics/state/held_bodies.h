#pragma once
/// The bodies that hands hold, and the pushes of the fields that these hands carry.

#include "dynamics/state/contact_events.h"
#include "dynamics/state/field_set.h"
#include "dynamics/state/world_objects.h"

#include <vector>

namespace stadion {

class HeldBodies {
public:
  HeldBodies(const WorldTime& time, const WorldObjects& objects, const FieldSet& fields,
             ContactMemory& memory)
      : time_(time), objects_(objects), fields_(fields), memory_(memory) {}

  /// The body is held at the pose that it has; until it is moved, it stays there.
  void add(RigidBody& b);
  void forget(RigidBody& b) { std::erase(list_, &b); }
  /// Bodies that have been let go leave the list.
  void dropReleased();
  /// May contain bodies that have been let go in this frame.
  const std::vector<RigidBody*>& list() const { return list_; }

  void carryFields(RigidBody& b, std::vector<FieldId> fields) const;
  /// Adds up what carried fields do to held bodies up to tau. Expects that no field is switched meanwhile.
  void accumulate(double tau);
  /// Pairs that only external motion moves touch until they are apart at the end of a frame.
  void endTouches();

  template <class Fields, class Find>
  void state(Fields& f, const Find& find) {
    listState("held", list_, f, find);
  }

private:
  const WorldTime& time_;
  const WorldObjects& objects_;
  const FieldSet& fields_;
  ContactMemory& memory_;
  std::vector<RigidBody*> list_;
};

constexpr double kCarriedApart = 1e-5;  ///< pairs moved from outside touch while they are nearer [m]

/// Returns true if both sides are moved from outside, so that no impulse can change either.
bool bothCarried(const Side& a, const Side& b);

}  // namespace stadion
