#pragma once
/// Resolves touches: impacts, landings on a face, embedded tips, the begin of lasting contact.
///
/// Threads  one at a time, as the world that it belongs to (world.h).

#include "dynamics/contact/contact_solver.h"
#include "dynamics/world/release_watch.h"
#include "dynamics/world/waking.h"

namespace stadion {

class Impacts {
public:
  Impacts(const WorldTime& time, const StepGrid& grid, EventQueue& queue, WorldObjects& objects,
          const FieldSet& fields, ContactMemory& memory, SweptBoxes& boxes, BodyArcs& arcs,
          FlushSurfaces& surfaces, Foresight& foresight, Waking& waking, ReleaseWatch& releases,
          const ImpactSearch& search, World::Counters& counters)
      : time_(time), grid_(grid), queue_(queue), objects_(objects), fields_(fields), memory_(memory),
        boxes_(boxes), arcs_(arcs), surfaces_(surfaces), foresight_(foresight), waking_(waking),
        releases_(releases), search_(search), counters_(counters) {}

  /// Two sides touch at tau.
  void onTouch(const Touch& touch, ContactSide a, ContactSide b, double tau);
  /// The body goes on with the velocities of m; `lasting`: in the contact solver.
  void afterImpulse(RigidBody& b, const SolverBody& m, double tau, bool lasting);

private:
  struct Collision;
  struct Rebound {
    double restitution;
    bool onFace;  ///< a face may carry the ball from now on
    bool ends;    ///< the two stay in contact
  };

  Collision collisionOf(const Touch& touch, ContactSide pa, ContactSide pb, double tau) const;
  ContactMemory::Waiting* record(const Collision& at, const Vec3& x, double impulse);
  void touchImmovable(const Collision& at);
  void embed(Collision& at);
  Vec3 pullOn(const RigidBody& body, double tau) const;
  Rebound reboundOf(const Collision& at, double restitution);
  void bounce(Collision& at);
  bool landOnFace(const Collision& at);
  void recordBeside(const Collision& at, const std::vector<PatchSide>& others, bool lasting);
  void countImpact(RigidBody& b, double tau) const;
  void embedTip(RigidBody& b, ContactSide in, const Vec3& v, double tau);
  void strikeInPile(RigidBody& b, const SolverBody& m, double tau);

  const WorldTime& time_;
  const StepGrid& grid_;
  EventQueue& queue_;
  WorldObjects& objects_;
  const FieldSet& fields_;
  ContactMemory& memory_;
  SweptBoxes& boxes_;
  BodyArcs& arcs_;
  FlushSurfaces& surfaces_;
  Foresight& foresight_;
  Waking& waking_;
  ReleaseWatch& releases_;
  const ImpactSearch& search_;
  World::Counters& counters_;
};

}  // namespace stadion
