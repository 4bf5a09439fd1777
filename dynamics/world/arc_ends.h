#pragma once
/// What happens when an arc ends: the flight goes on, a ball comes to the end of its slide or of its face,
/// guided motion turns.
///
/// Threads  one at a time, as the world that it belongs to (world.h).

#include "dynamics/world/waking.h"

namespace stadion {

class ArcEnds {
public:
  ArcEnds(const WorldObjects& objects, BodyArcs& arcs, FlushSurfaces& surfaces, Foresight& foresight,
          Waking& waking)
      : objects_(objects), arcs_(arcs), surfaces_(surfaces), foresight_(foresight), waking_(waking) {}

  void reachHorizon(RigidBody& b, double tau);
  void reachHorizon(Collider& c, double tau);

private:
  bool crossEdge(RigidBody& b, double tau, double& lift);
  bool crossFold(RigidBody& b, double tau) const;

  const WorldObjects& objects_;
  BodyArcs& arcs_;
  FlushSurfaces& surfaces_;
  Foresight& foresight_;
  Waking& waking_;
};

}  // namespace stadion
