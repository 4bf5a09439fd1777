#pragma once
/// Begins the arcs of bodies: flight, motion on a face, rest, quarantine.
///
/// A new arc gets a new version, so that older predictions are void. It is noted in the traces, and marked
/// for prediction unless events run. The caller predicts what the arc meets (foresight.h).
///
/// Threads  one at a time, as the world that it belongs to (world.h).

#include "dynamics/body/ball_motion.h"
#include "dynamics/motion/coupled_step.h"
#include "dynamics/state/body_lists.h"
#include "dynamics/state/body_traces.h"
#include "dynamics/state/contact_events.h"
#include "dynamics/state/field_set.h"
#include "dynamics/state/step_grid.h"
#include "dynamics/state/support_graph.h"
#include "dynamics/state/world_time.h"
#include "dynamics/world/world.h"

#include <string>

namespace stadion {

class BodyArcs {
public:
  BodyArcs(const WorldTime& time, const StepGrid& grid, const FieldSet& fields, ContactMemory& memory,
           ActiveBodies& active, ChangedMotions& changes, SupportGraph& supports, BodyTraces& traces,
           World::Counters& counters)
      : time_(time), grid_(grid), fields_(fields), memory_(memory), active_(active), changes_(changes),
        supports_(supports), traces_(traces), counters_(counters) {}

  /// From tau on the body follows this path and spin, for `horizon` seconds at most. A state that is not
  /// finite leads to quarantine.
  void setArc(RigidBody& b, double tau, const Path& path, const Spin& spin, double horizon, BodyMode mode);
  /// Flight from p with velocity v, attitude q and angular momentum L.
  void startFlight(RigidBody& b, double tau, const Vec3& p, const Vec3& v, const Quat& q, const Vec3& L);
  /// Flight from here; the spin continues unless it ends too. `pullsAsBefore`: the forces are those of the
  /// last arc.
  void continueFlight(RigidBody& b, double tau, const Vec3& p, const Vec3& v, bool pullsAsBefore);
  /// The next arc of a flight that goes on. False if only the expansion of the spin ended.
  bool flyOn(RigidBody& b, double tau);
  /// Slide, roll or rest on the face in `b.support`, or flight if the ball leaves it.
  void startOnFace(RigidBody& b, double tau, const BallStart& s, bool gripped, bool stopped);
  void freeze(RigidBody& b, double tau);
  /// The body stays at its last good pose; `why` says what went wrong.
  void quarantine(RigidBody& b, double tau, std::string why);
  /// The bias of the paper turns a flying body once, at the start of a frame, however long that is.
  void turnByBias(RigidBody& b, double tau);

private:
  void setPath(RigidBody& b, double tau, const Path& path, double horizon, BodyMode mode);
  void setSpin(RigidBody& b, double tau, const Spin& spin);
  void fly(RigidBody& b, double tau, const Vec3& p, const Vec3& v);
  bool resist(RigidBody& b, double tau, const Vec3& p, const Vec3& v);
  bool flyInAir(RigidBody& b, double tau, const CoupledState& s);
  Spin spinFrom(const RigidBody& b, double tau, const CoupledState& s) const;
  BallArc arcOnFace(const RigidBody& b, double tau, const BallStart& s, bool gripped, bool stopped) const;
  double restLasts(const RigidBody& b, const BallStart& s, double tau) const;

  const WorldTime& time_;
  const StepGrid& grid_;
  const FieldSet& fields_;
  ContactMemory& memory_;
  ActiveBodies& active_;
  ChangedMotions& changes_;
  SupportGraph& supports_;
  BodyTraces& traces_;
  World::Counters& counters_;
};

}  // namespace stadion
