#pragma once
/// Lasting contact begins, and bodies wake when what they lean on changes.
///
/// Threads  one at a time, as the world that it belongs to (world.h).

#include "dynamics/world/body_arcs.h"
#include "dynamics/world/foresight.h"

namespace stadion {

class Waking {
public:
  Waking(const WorldTime& time, const StepGrid& grid, EventQueue& queue, const WorldObjects& objects,
         SupportGraph& supports, const ActiveBodies& active, BodyArcs& arcs, Foresight& foresight)
      : time_(time), grid_(grid), queue_(queue), objects_(objects), supports_(supports), active_(active),
        arcs_(arcs), foresight_(foresight) {}

  /// The contact solver advances the body from tau on.
  void enterContact(RigidBody& b, double tau);
  /// The sleeping body wakes, and the bodies that lean on it.
  void wake(RigidBody& b, double tau);
  /// Bodies that lean on `moved` fall or find new support, and so do the bodies that lean on them.
  void wakeOnto(ContactSide moved, double tau);
  /// A new arc from the present state, because what acts on the body has changed.
  void restart(RigidBody& b, double tau);
  /// The next tick is when the first body in contact is due.
  void scheduleDue(double tau);

private:
  void cutStep(RigidBody& b, double tau);
  void hurry(RigidBody& b, double tau);
  bool wakeLeaner(RigidBody& b, const ContactSide& gone, double tau);
  void fly(RigidBody& b, double tau, const Vec3& v, const Vec3& angularMomentum);

  const WorldTime& time_;
  const StepGrid& grid_;
  EventQueue& queue_;
  const WorldObjects& objects_;
  SupportGraph& supports_;
  const ActiveBodies& active_;
  BodyArcs& arcs_;
  Foresight& foresight_;
};

}  // namespace stadion
