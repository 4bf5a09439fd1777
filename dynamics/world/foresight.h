#pragma once
/// Predicts, for each new arc, what the body meets before the window ends, and posts the events.
///
/// Lazy     a body with nothing near its path computes its next arcs only on request (catchUp).
/// Threads  one at a time, as the world that it belongs to (world.h).

#include "dynamics/state/event_queue.h"
#include "dynamics/state/swept_boxes.h"
#include "dynamics/world/body_arcs.h"
#include "dynamics/world/flush_surfaces.h"

namespace stadion {

constexpr double kSameTime = 1e-9;  ///< times that differ by less are equal [s]

class Foresight {
public:
  Foresight(WorldTime& time, EventQueue& queue, WorldObjects& objects, ContactMemory& memory,
            ActiveBodies& active, ChangedMotions& changes, SweptBoxes& boxes, BodyArcs& arcs,
            FlushSurfaces& surfaces, World::Counters& counters)
      : time_(time), queue_(queue), objects_(objects), memory_(memory), active_(active), changes_(changes),
        boxes_(boxes), arcs_(arcs), surfaces_(surfaces), counters_(counters) {}

  /// Predicts what the body's new arc meets from tau to the end of the window, or marks it for later.
  void predict(RigidBody& b, double tau);
  /// Predicts contacts after the spin alone has changed: the path of the body stays as it was predicted.
  void predictSpin(RigidBody& b, double tau);
  /// Predicts contacts of a collider whose motion has turned.
  void predict(Collider& c, double tau);
  /// Predicts contacts from tau on for all changed motions.
  void predictChanged(double tau);
  /// A pair that no contact moves has touched at tau: it may part and meet again before its motion turns.
  void predictAgain(const Side& a, const Side& b, double tau) { predictPair(a, b, tau); }

  /// Makes the arcs of a lazy body up to tau.
  void catchUp(RigidBody& b, double tau) {
    while (b.lazy && b.until <= tau) flyOnLazily(b);
  }
  /// Calls f(body) for the bodies near `box`, with their arcs at tau.
  template <class F>
  void eachBodyNear(const Aabb& box, double tau, F f) {
    boxes_.eachBody(box, [&](RigidBody& o) {
      catchUp(o, tau);
      f(o);
    });
  }
  /// Returns the number of moving balls whose gap to this ball is less than its radius. They will soon lean
  /// on each other.
  std::size_t ballsAround(const RigidBody& b, double tau);

  /// Returns the length of the next window; it grows while nothing is near.
  Nanoseconds nextWindow() const;
  /// Begins a window: all events are void.
  void beginWindow() {
    predictions_ = {};
    queue_.clear();
  }
  /// Predicts contacts of all active bodies from tau on; shortens a long window if something is near.
  void fillWindow(double tau);

  template <class Fields>
  void state(Fields& f) {
    f("predicted arcs", predictions_.arcs), f("pairs with colliders", predictions_.colliders),
        f("pairs of bodies", predictions_.bodies);
  }

private:
  /// Counts in this window: predicted arcs, and tested pairs with colliders and between bodies.
  struct Predictions {
    std::size_t arcs = 0, colliders = 0, bodies = 0;
  };
  void predictNearby(RigidBody& b, double tau, bool onlyHigherIds);
  void predictNearCollider(RigidBody& b, double tau);
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
  Predictions predictions_;
};

}  // namespace stadion
