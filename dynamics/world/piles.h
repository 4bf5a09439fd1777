#pragma once
/// Many bodies in contact, advanced together in steps of 1/120 s (contact/crowd_solver.h).

#include "dynamics/world/contact_finder.h"
#include "dynamics/world/waking.h"

#include <span>
#include <vector>

namespace stadion {

struct CrowdStep;

class Piles {
public:
  Piles(const WorldTime& time, const StepGrid& grid, const WorldObjects& objects, const FieldSet& fields,
        ContactMemory& memory, const ActiveBodies& active, SweptBoxes& boxes, BodyArcs& arcs,
        Foresight& foresight, Waking& waking)
      : time_(time), grid_(grid), objects_(objects), fields_(fields), memory_(memory), active_(active),
        boxes_(boxes), arcs_(arcs), foresight_(foresight), waking_(waking) {}

  /// Whether an island is to become a pile: it is large, not solved exactly, or its balls have many
  /// neighbours.
  bool isPile(const std::vector<RigidBody*>& island, double tau);
  /// One step of all members that are due at tau.
  void advance(double tau);

private:
  void dissolve(const std::vector<RigidBody*>& due, double tau);
  void join(RigidBody& b, CrowdStep& step);
  void findContacts(RigidBody& b, CrowdStep& step);
  void findColliders(const RigidBody& b, const Aabb& box, double margin, CrowdStep& step);
  void meet(RigidBody& b, RigidBody& o, double margin, CrowdStep& step);
  void addContact(const RigidBody& b, Party other, const Surface& surface, const Gap& gap,
                  std::uint32_t feature, CrowdStep& step);
  std::vector<Vec3> placesOfFriction(const CrowdStep& step) const;
  void linkContacts(CrowdStep& step);
  bool noteNeighbours(const CrowdStep& step, std::size_t i, std::span<const std::uint32_t> list,
                      std::vector<Party>& near);
  void follow(const CrowdStep& step, std::size_t i);
  void conclude(CrowdStep& step);

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

constexpr std::size_t kPileOfBalls = 5;  ///< so many balls close together are a pile

}  // namespace stadion
