#pragma once
/// The inside of World: the classes that keep its state and those that move its bodies, in the order in which
/// they use each other. Core itself only orders them through a frame (world_frame.cpp). It has more than 20
/// fields, because each of these classes is one of them.
///
/// State    dynamics/state: time, objects, fields, events, boxes. Each class there owns its fields.
/// Motion   body_arcs begins arcs, and foresight predicts what they meet. waking, impacts, arc_ends and
///          arrivals say what happens at an event. contact_islands, island_step and piles advance lasting
///          contact.
/// Threads  one at a time, as the world that it belongs to (world.h).

#include "dynamics/state/event_queue.h"
#include "dynamics/state/field_commands.h"
#include "dynamics/world/arc_ends.h"
#include "dynamics/world/arrivals.h"
#include "dynamics/world/contact_islands.h"
#include "dynamics/world/impacts.h"
#include "dynamics/world/world.h"

#include <vector>

namespace stadion {

class World::Core {
public:
  // --- one frame (world_frame.cpp)
  void start(Nanoseconds at);
  void advance(Nanoseconds from, Nanoseconds to, bool continues);
  void pause(Nanoseconds to, bool continues);
  void restartStirred(double tau);
  void forgetBody(RigidBody& b);
  bool putBody(RigidBody& b, const Pose& X_WN, const Vec3& v, const Vec3& omega);
  void visitState(StateFields& f);

  // --- state
  WorldTime time_;
  StepGrid grid_;
  EventQueue queue_;
  Counters counters_;
  WorldObjects objects_;
  FieldSet fields_{time_};
  ContactMemory memory_;
  ActiveBodies active_;
  ChangedMotions changes_;
  SweptBoxes boxes_{time_, objects_};
  SupportGraph supports_{objects_};
  BodyTraces traces_{time_, objects_, memory_};
  HeldBodies held_{time_, objects_, fields_, memory_};
  FieldCommands commands_{time_, queue_, objects_, fields_, held_};
  PenetrationRecoveries recoveries_{time_, objects_, fields_, boxes_, held_};
  std::vector<BodyId> changed_;  ///< bodies that have been active in this frame
  bool turnsByFrame_ = false;    ///< a body has been added whose bias turns it once a frame

  // --- motion
  BodyArcs arcs_{time_, grid_, fields_, memory_, active_, changes_, supports_, traces_, counters_};
  ImpactSearch search_{time_, counters_};
  FlushSurfaces surfaces_{objects_, boxes_, memory_, search_};
  Foresight foresight_{time_,    queue_, objects_, memory_,   active_,
                       changes_, boxes_, arcs_,    surfaces_, counters_};
  Waking waking_{time_, grid_, queue_, objects_, supports_, active_, arcs_, foresight_};
  ReleaseWatch releases_{time_, objects_, memory_, traces_};
  Impacts impacts_{time_, grid_,     queue_,     objects_, fields_,   memory_, boxes_,
                   arcs_, surfaces_, foresight_, waking_,  releases_, search_, counters_};
  ArcEnds ends_{objects_, arcs_, surfaces_, foresight_, waking_};
  Arrivals arrivals_{time_,    objects_, fields_, memory_, active_,
                     changes_, boxes_,   arcs_,   waking_, recoveries_};
  ContactFinder finder_{grid_, objects_, fields_, boxes_, foresight_};
  IslandStep step_{time_, objects_, fields_, memory_, releases_, arcs_, surfaces_, waking_, finder_};
  Piles piles_{time_, grid_, objects_, fields_, memory_, active_, boxes_, arcs_, foresight_, waking_};
  ContactIslands islands_{time_,   grid_,   queue_, objects_, active_,  foresight_,
                          waking_, finder_, step_,  piles_,   counters_};

private:
  void beginFrame();
  void beginPart();
  void runEvents(double until);
  void fetchNext() const;
  void endPart();
  void sample(RigidBody& b);
  void expel(RigidBody& b);
  void turnByFrame();
  void beginWindow(Nanoseconds at);
  void openWindow(Nanoseconds at);
};

}  // namespace stadion
