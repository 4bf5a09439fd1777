#pragma once
/// Where every movable node is: a tree of placements in flat arrays. Here App keeps the pose of a node; the
/// other places are in docs/architecture.md ("Where a pose is kept").
///
/// A placement has a local matrix relative to its parent, and a World matrix that follows from it. A
/// placement that a tracker or a dynamics node moves is held in World instead. Its parent does not carry it,
/// so the order in which the two move does not matter. A World matrix is computed on request, and only if the
/// placement or one above it has moved since.
///
/// A fleet is many placements that one node moves by a rule. Poses of its members are computed only when they
/// are published. A member that is watched, held, hidden or put elsewhere, or that carries others, is
/// detached: the fleet then moves it by itself.
///
/// Frames     X_PN maps Node to Parent coordinates, X_WN Node to World.
/// Ownership  borrows the rules of fleets.
/// Threads    App only; other stages see published instance records. Const functions write caches (World
///            matrices, poses of fleets), so not even two readers may call them at once.
/// Errors     a setter refuses a non-finite matrix: it returns false and keeps the old one.

#include "engine/maths/maths.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace stadion {

class StateFields;

using PlacementId = std::uint32_t;
constexpr PlacementId kWorldPlacement = 0;  ///< World itself: the identity, never moves
constexpr PlacementId kNoPlacement = ~PlacementId{0};

/// The reasons to hide a placement; it is shown while there is none.
enum class Hider : std::uint8_t {
  Author = 1,       ///< the script, and its messages
  Level = 2,        ///< an lod node above it draws another child
  Degradation = 4,  ///< the node must save time
};

/// The parts of a placement's pose that are held in World.
enum class HeldParts : std::uint8_t { Nothing, Position, Orientation, All };
constexpr HeldParts lastOf(HeldParts) {
  return HeldParts::All;
}

/// Where a member of a fleet is.
struct MemberPlace {
  std::array<double, 12> rows;  ///< X_PN (3 x 4), row after row; finite
  double widens;                ///< sphereScale() of it (records.h), which does not change from move to move

  Affine affine() const {
    Affine X_PN;
    X_PN.matrix() = Eigen::Map<const Eigen::Matrix<double, 3, 4, Eigen::RowMajor>>(rows.data());
    return X_PN;
  }
};

/// Computes where the members of a fleet are.
class FleetRule {
public:
  /// Fills `places` for member `first` and those after it, as of the last moveFleet().
  virtual void putMembers(std::size_t first, std::span<MemberPlace> places) const = 0;

protected:
  FleetRule() = default;
  FleetRule(const FleetRule&) = default;
  FleetRule& operator=(const FleetRule&) = default;
  ~FleetRule() = default;
};

using FleetId = std::uint32_t;
constexpr FleetId kNoFleet = ~FleetId{0};

class Placements {
public:
  Placements();

  PlacementId add(PlacementId parent, const Affine& X_PN);
  /// Expects that its children are gone.
  void remove(PlacementId id);

  /// Places the node at X_PN below its parent, which carries it from now on.
  bool setLocal(PlacementId id, const Affine& X_PN);
  /// Makes a fleet of the members, which keep their poses until the fleet moves. `rule` lives until
  /// removeFleet().
  FleetId addFleet(const FleetRule& rule, std::span<const PlacementId> members);
  /// Removes the fleet; its members keep their poses.
  void removeFleet(FleetId fleet);
  /// Moves all members by the rule, except attached ones.
  void moveFleet(FleetId fleet);
  /// Calls visit(ids, places) for members that have moved with their fleets since the last call, a block at a
  /// time. kNoPlacement stands for a detached member. All of them are shown, and their parent is World.
  template <class Visit>
  void takeMovedFleets(const Visit& visit);
  /// Sets the local pose so that the World pose becomes X_WN.
  bool setWorld(PlacementId id, const Affine& X_WN);
  /// Holds the placement at X_WN in World, or only its position or orientation, until setLocal(), setWorld()
  /// or rejoin().
  bool holdInWorld(PlacementId id, const Affine& X_WN, HeldParts parts = HeldParts::All);
  /// Attaches the placement to its parent again, as the two stood when the parent was at X_WP.
  void rejoin(PlacementId id, const Affine& X_WP);
  /// Sets whether a tracker or a dynamics node moves the placement. If so, its fleet does not move it.
  void setAttached(PlacementId id, bool attached);
  HeldParts heldParts(PlacementId id) const { return entries_[id].heldParts; }
  const Affine& world(PlacementId id) const;
  Affine local(PlacementId id) const;  ///< relative to its parent now
  /// Where its fleet puts it, with the numbers of takeMovedFleets(); nothing if it is in no fleet.
  std::optional<MemberPlace> inFleet(PlacementId id) const;
  PlacementId parent(PlacementId id) const { return entries_[id].parent; }
  bool has(PlacementId id) const { return id < entries_.size() && entries_[id].live; }
  /// The placement that carries it: its parent, or World if it is held there.
  PlacementId carrier(PlacementId id) const;

  /// Hides or shows this placement and everything below it.
  void setShown(PlacementId id, bool shown, Hider hider = Hider::Author);
  bool shown(PlacementId id) const;  ///< itself and everything above it

  /// From now on takeMovedWatched() returns this placement if it has moved.
  void watch(PlacementId id);
  bool anyWatched() const { return anyWatched_; }  ///< any placement, ever
  /// Returns true if this placement or one below it has ever been watched.
  bool watchedBelow(PlacementId id) const { return entries_[id].watchedBelow; }
  /// Returns the watched placements that have moved since the last call. Valid until the next call.
  const std::vector<PlacementId>& takeMovedWatched();

  /// Every placement that takeMovedFleets() leaves out and whose World matrix or visibility may have changed
  /// since the last call, each once.
  /// Valid until the next one.
  const std::vector<PlacementId>& takeChanged();

  /// Saves or restores everything but the rules, which resumeFleet() restores. Until then, callers must not
  /// ask where their members are.
  void state(StateFields& f);
  bool resumeFleet(FleetId fleet, const FleetRule& rule, std::size_t members);

private:
  /// Kept apart from the matrices, so that a search over many placements reads little memory.
  struct Entry {
    PlacementId parent = kNoPlacement, firstChild = kNoPlacement, nextSibling = kNoPlacement,
                previousSibling = kNoPlacement;
    HeldParts heldParts = HeldParts::Nothing;
    bool stale = false;    ///< the World matrix must be recomputed
    bool changed = false;  ///< is in changed_
    std::uint8_t hiders = 0;
    bool live = false;
    bool watched = false, watchedBelow = false;
    bool attached = false;
    bool detached = false;     ///< from some fleet
    FleetId fleet = kNoFleet;  ///< fleet that moves the placement
    std::uint32_t member = 0;
    std::uint32_t move = 0;  ///< the fleet's move after which its local matrix was written

    template <class Self, class Fields>
    static void fields(Self& e, Fields& f) {
      f("parent", e.parent), f("first child", e.firstChild);
      f("next sibling", e.nextSibling), f("previous sibling", e.previousSibling);
      f("held", e.heldParts), f("hiders", e.hiders), f("live", e.live), f("attached", e.attached);
      f("watched", e.watched), f("watched below", e.watchedBelow);
      f("detached", e.detached), f("fleet", e.fleet), f("member", e.member), f("move", e.move);
    }
  };
  struct Fleet {
    const FleetRule* rule = nullptr;                              ///< null: it has been removed
    std::vector<PlacementId> members;                             ///< kNoPlacement: detached, or removed
    std::vector<std::pair<std::uint32_t, PlacementId>> detached;  ///< by number
    std::uint32_t moves = 0;
    bool moved = false;  ///< since takeMovedFleets()

    template <class Self, class Fields>
    static void fields(Self& fleet, Fields& f) {
      f("members", fleet.members), f("detached", fleet.detached), f("moves", fleet.moves);
    }
  };
  static constexpr std::size_t kFleetBlock = 64;

  /// Returns true if its World matrix is the local one.
  static bool standsInWorld(const Entry& e) {
    return e.parent == kWorldPlacement && e.heldParts == HeldParts::Nothing;
  }
  Affine carriedBy(PlacementId id, const Affine& X_WP) const;
  void markBelow(PlacementId id, bool moved);
  bool standsTogether() const;
  bool freeListsFit() const;
  bool fleetsFit() const;
  void updateLocal(PlacementId id) const;
  MemberPlace memberOf(const Fleet& fleet, std::uint32_t member) const;
  void join(PlacementId id, FleetId fleet, std::uint32_t member);
  void leaveFleet(PlacementId id);
  void detach(PlacementId id);
  void placeDetached(const Fleet& fleet);
  void mark(PlacementId id, Entry& e) {
    if (e.changed) return;
    e.changed = true;
    changed_.push_back(id);
  }

  mutable std::vector<Entry> entries_;
  mutable std::vector<Affine> X_PN_;  ///< by placement
  mutable std::vector<Affine> X_WN_;  ///< by placement; unused while one of the others is its World matrix
  std::vector<Affine> X_WH_;          ///< by placement: where it is held
  bool anyWatched_ = false;
  std::vector<PlacementId> free_;
  std::vector<PlacementId> changed_, movedWatched_;
  std::vector<PlacementId> changedTold_, movedTold_;
  std::vector<Fleet> fleets_;
  std::vector<FleetId> freeFleets_;
  std::array<MemberPlace, kFleetBlock> block_;  ///< takeMovedFleets()'s own
  mutable std::vector<PlacementId> chain_;      ///< world()'s own
};

template <class Visit>
void Placements::takeMovedFleets(const Visit& visit) {
  for (Fleet& fleet : fleets_) {
    if (!std::exchange(fleet.moved, false)) continue;
    const std::span<const PlacementId> members(fleet.members);
    for (std::size_t first = 0; first < members.size(); first += kFleetBlock) {
      const std::size_t count = std::min(kFleetBlock, members.size() - first);
      const std::span<MemberPlace> places(block_.data(), count);
      fleet.rule->putMembers(first, places);
      visit(members.subspan(first, count), std::span<const MemberPlace>(places));
    }
  }
}

}  // namespace stadion
