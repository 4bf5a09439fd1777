#pragma once
/// Advances bodies in lasting contact, tick by tick: groups them into islands, and gives each island to the
/// solver of small islands or to the piles.
///
/// Threads  one at a time, as the world that it belongs to (world.h).

#include "dynamics/world/island_step.h"
#include "dynamics/world/piles.h"

#include <vector>

namespace stadion {

class ContactIslands {
public:
  ContactIslands(const WorldTime& time, const StepGrid& grid, EventQueue& queue, const WorldObjects& objects,
                 const ActiveBodies& active, Foresight& foresight, Waking& waking, ContactFinder& finder,
                 IslandStep& step, Piles& piles, World::Counters& counters)
      : time_(time), grid_(grid), queue_(queue), objects_(objects), active_(active), foresight_(foresight),
        waking_(waking), finder_(finder), step_(step), piles_(piles), counters_(counters) {}

  /// Takes one step of all bodies in contact that are due at tau.
  void tick(double tau);

private:
  void findAll(double tau, std::vector<RigidBody*>& set, std::vector<FoundContact>& found);
  std::vector<ContactIsland> group(const std::vector<RigidBody*>& set,
                                   std::vector<FoundContact>& found) const;
  bool wakeTouched(const std::vector<FoundContact>& found, double tau);

  const WorldTime& time_;
  const StepGrid& grid_;
  EventQueue& queue_;
  const WorldObjects& objects_;
  const ActiveBodies& active_;
  Foresight& foresight_;
  Waking& waking_;
  ContactFinder& finder_;
  IslandStep& step_;
  Piles& piles_;
  World::Counters& counters_;
};

}  // namespace stadion
