#pragma once
/// Finds the contact points of bodies in lasting contact, and joins those of flush pieces.
///
/// Threads  one at a time, as the world that it belongs to (world.h).

#include "dynamics/collision/manifold.h"
#include "dynamics/contact/contact_area.h"
#include "dynamics/contact/contact_solver.h"
#include "dynamics/world/foresight.h"

#include <cstdint>
#include <span>
#include <vector>

namespace stadion {

/// Names a contact point of a pair.
std::uint64_t pairKey(ContactSide a, ContactSide b, std::uint32_t feature);

/// A contact point of a body.
struct FoundContact {
  SolverContact contact;
  ContactSide a, b;  ///< a is the body
  PairSurface surface;
  Gap gap;
  std::uint64_t key = 0;
  Carrier carrier = Carrier::None;
  Rounding rounding;
};

class ContactFinder {
public:
  /// A collider that a body touches, or comes to, without a contact of its own.
  struct Beside {
    BodyId body = 0;
    ContactSide piece;
    bool touches = false;
    auto operator<=>(const Beside&) const = default;
  };

  ContactFinder(const StepGrid& grid, const WorldObjects& objects, const FieldSet& fields,
                const SweptBoxes& boxes, Foresight& foresight)
      : grid_(grid), objects_(objects), fields_(fields), boxes_(boxes), foresight_(foresight) {}

  /// A tick begins.
  void clear() { beside_.clear(); }
  /// Appends the contacts of a body at tau to `found`, and to `set` the bodies in contact that come along.
  void find(RigidBody& b, double tau, std::vector<FoundContact>& found, std::vector<RigidBody*>& set);
  /// All bodies have been looked at: expected before besideOf().
  void sort();
  std::span<const Beside> besideOf(BodyId id) const;

private:
  void chooseRecovery(const RigidBody& b, std::size_t first, std::vector<FoundContact>& found) const;
  /// Adds a point of the body at another side.
  void addPoint(const RigidBody& b, const Side& other, const ManifoldPoint& p,
                std::vector<FoundContact>& found) const;
  void addBeyondBorders(const RigidBody& b, double tau, double margin, std::size_t first,
                        std::vector<FoundContact>& found) const;
  void dropHidden(const RigidBody& b, double tau, std::size_t first, std::vector<FoundContact>& found);
  void joinFlush(const RigidBody& b, std::size_t first, std::vector<FoundContact>& found);
  bool isOnStillCollider(const FoundContact& f) const;
  bool groupOf(std::size_t i, const std::vector<FoundContact>& found, const std::vector<char>& grouped,
               std::vector<std::size_t>& group) const;
  bool dropBetween(const RigidBody& b, std::size_t first, const std::vector<std::size_t>& group,
                   const std::vector<FoundContact>& found, std::vector<char>& gone);
  bool keepCorners(const RigidBody& b, const std::vector<std::size_t>& group, const std::vector<char>& corner,
                   std::vector<FoundContact>& found, std::vector<char>& gone);

  const StepGrid& grid_;
  const WorldObjects& objects_;
  const FieldSet& fields_;
  const SweptBoxes& boxes_;
  Foresight& foresight_;
  std::vector<Beside> beside_;  ///< in this tick; sorted by body after sort()
};

}  // namespace stadion
