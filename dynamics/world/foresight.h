#pragma once
/// Predicts, for each new arc, what the body meets before the window ends, and posts the events.
///
/// Lazy     a body with nothing near its path computes its next arcs only on request (catchUp).

#include "dynamics/state/event_queue.h"
#include "dynamics/state/swept_boxes.h"
#include "dynamics/world/body_arcs.h"
#include "dynamics/world/flush_surfaces.h"

namespace stadion {

constexpr double kDue = 1e-9;  ///< times as near as this are the same [s]

class Foresight {
public:
  Foresight(WorldTime& time, EventQueue& queue, WorldObjects& objects, ContactMemory& memory,
            ActiveBodies& active, ChangedMotions& changes, SweptBoxes& boxes, BodyArcs& arcs,
            FlushSurfaces& surfaces, World::Counters& counters)
      : time_(time), queue_(queue), objects_(objects), memory_(memory), active_(active), changes_(changes),
        boxes_(boxes), arcs_(arcs), surfaces_(surfaces), counters_(counters) {}

  /// Predicts what the body's new arc meets from tau to the end of the window, or marks it for later.
  void predict(RigidBody& b, double tau);
  /// The same if the spin alone has changed: the body goes where it was seen to go.
  void predictSpin(RigidBody& b, double tau);
  /// The collider has turned: predicts what comes near it.
  void predict(Collider& c, double tau);
  /// Looks ahead from tau for all changed motions.
  void predictChanged(double tau);

  /// Makes the arcs of a lazy body up to tau.
  void catchUp(RigidBody& b, double tau) {
    while (b.lazy && b.until <= tau) flyOnLazily(b);
  }
  /// Calls f(body) for the bodies near `box`, with their arcs at tau.
  template <class F>
  void eachBodyNear(const Aabb& box, double tau, F f) {
    boxes_.eachBody(box, [&](RigidBody& o) { catchUp(o, tau), f(o); });
  }
  /// How many balls move within its own size around this ball: they will soon lean on each other.
  std::size_t ballsAround(const RigidBody& b, double tau);

  /// Length of the next window; it grows while nothing is near.
  Nanoseconds nextWindow() const;
  /// All events are void: a window begins.
  void beginWindow() { looks_ = {}, queue_.clear(); }
  /// Looks ahead for all active bodies from tau; shortens a long window if something is near.
  void fillWindow(double tau);

  template <class Fields>
  void state(Fields& f) {
    f("looks", looks_.looks), f("collider looks", looks_.colliders), f("body looks", looks_.bodies);
  }

private:
  /// Predictions in this window, and how much was near.
  struct Looks {
    std::size_t looks = 0, colliders = 0, bodies = 0;
  };
  void lookAhead(RigidBody& b, double tau, bool onlyGreater);
  void lookAtOnly(RigidBody& b, double tau);
  void awaitHorizon(RigidBody& b);
  void flyOnLazily(RigidBody& b);
  void comeNear(RigidBody& b, double tau);
  void predictPair(const Side& a, const Side& b, double tau);
  void pushHorizon(const RigidBody& b);
  void pushTurn(ContactSide p, const GuidedMotion& motion, double tau);
  bool solidsMayMeet() const;
  double knownUntil(const Side& s) const;

  WorldTime& time_;
  EventQueue& queue_;
  WorldObjects& objects_;
  ContactMemory& memory_;
  ActiveBodies& active_;
  ChangedMotions& changes_;
  SweptBoxes& boxes_;
  BodyArcs& arcs_;
  FlushSurfaces& surfaces_;
  World::Counters& counters_;
  Looks looks_;
};

}  // namespace stadion
