#pragma once
/// Many bodies in contact, advanced together in steps of 1/120 s (contact/pile_solver.h).
///
/// Threads  one at a time, as the world that it belongs to (world.h).

#include "dynamics/world/contact_finder.h"
#include "dynamics/world/waking.h"

#include <span>
#include <vector>

namespace stadion {

struct PileStep;

class Piles {
public:
  Piles(const WorldTime& time, const StepGrid& grid, const WorldObjects& objects, const FieldSet& fields,
        ContactMemory& memory, const ActiveBodies& active, SweptBoxes& boxes, BodyArcs& arcs,
        Foresight& foresight, Waking& waking)
      : time_(time), grid_(grid), objects_(objects), fields_(fields), memory_(memory), active_(active),
        boxes_(boxes), arcs_(arcs), foresight_(foresight), waking_(waking) {}

  /// Returns true if an island is to become a pile: it is large, not solved exactly, or its balls have many
  /// neighbours.
  bool isPile(const std::vector<RigidBody*>& island, double tau);
  /// Takes one step of all members that are due at tau.
  void advance(double tau);

private:
  void dissolve(const std::vector<RigidBody*>& due, double tau);
  void join(RigidBody& b, PileStep& step);
  void findContacts(RigidBody& b, PileStep& step);
  void findColliders(const RigidBody& b, const Aabb& box, double margin, PileStep& step);
  void meet(RigidBody& b, RigidBody& o, double margin, PileStep& step);
  void addContact(const RigidBody& b, ContactSide other, const Surface& surface, const Gap& gap,
                  std::uint32_t feature, PileStep& step);
  std::vector<Vec3> placesOfFriction(const PileStep& step) const;
  void linkContacts(PileStep& step);
  bool noteNeighbours(const PileStep& step, std::size_t i, std::span<const std::uint32_t> list,
                      std::vector<ContactSide>& near);
  void follow(const PileStep& step, std::size_t i);
  void conclude(PileStep& step);

  const WorldTime& time_;
  const StepGrid& grid_;
  const WorldObjects& objects_;
  const FieldSet& fields_;
  ContactMemory& memory_;
  const ActiveBodies& active_;
  SweptBoxes& boxes_;
  BodyArcs& arcs_;
  Foresight& foresight_;
  Waking& waking_;
};

constexpr std::size_t kPileOfBalls = 5;  ///< number of balls close together that make a pile

}  // namespace stadion
