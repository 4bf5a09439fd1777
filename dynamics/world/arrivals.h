#pragma once
/// Bodies and colliders that have appeared or jumped: pairs that touch then are in contact and fire nothing.
///
/// Threads  one at a time, as the world that it belongs to (world.h).

#include "dynamics/world/penetration_recoveries.h"
#include "dynamics/world/waking.h"

#include <utility>
#include <vector>

namespace stadion {

class Arrivals {
public:
  Arrivals(const WorldTime& time, WorldObjects& objects, const FieldSet& fields, ContactMemory& memory,
           const ActiveBodies& active, const ChangedMotions& changes, const SweptBoxes& boxes, BodyArcs& arcs,
           Waking& waking, PenetrationRecoveries& recoveries)
      : time_(time), objects_(objects), fields_(fields), memory_(memory), active_(active), changes_(changes),
        boxes_(boxes), arcs_(arcs), waking_(waking), recoveries_(recoveries) {}

  /// Places all that has arrived since the last frame, and wakes the bodies that it was put into.
  void placeAll();

private:
  std::vector<ContactSide> arrivals() const;
  void placeFresh(const std::vector<ContactSide>& arrived);
  void place(RigidBody& b, const std::vector<std::pair<Side, Gap>>& touching);
  void wakeWithin(ContactSide arrived);

  const WorldTime& time_;
  WorldObjects& objects_;
  const FieldSet& fields_;
  ContactMemory& memory_;
  const ActiveBodies& active_;
  const ChangedMotions& changes_;
  const SweptBoxes& boxes_;
  BodyArcs& arcs_;
  Waking& waking_;
  PenetrationRecoveries& recoveries_;
};

}  // namespace stadion
