#pragma once
/// Where every movable thing is: a tree of placements in flat arrays.
///
/// A placement has a local matrix relative to its parent, and a World matrix that follows from it. A
/// placement that a tracker or the dynamics moves is held in World instead: its parent does not carry it, so
/// the order in which the two move does not matter. A matrix is computed again only if the placement or one
/// above it moved. World matrices are always up to date in App.
///
/// A fleet is many placements that one node moves by a rule. Poses of its members are computed only when they
/// are published. A member that is watched, held, hidden or put elsewhere, or that carries others, leaves the
/// fleet: it is detached and moved by itself.
///
/// Frames     X_PN maps Node to Parent coordinates, X_WN Node to World.
/// Ownership  borrows the rules of fleets.
/// Threads    App only; other stages see published instance records.
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

/// What hides a placement; it is shown while nothing hides it.
enum class Hider : std::uint8_t {
  Author = 1,  ///< the script, and its messages
  Level = 2,   ///< an lod node above it draws another child
  Relief = 4,  ///< it costs too much
};

/// What of a placement is held in World.
enum class Held : std::uint8_t { Nothing, Position, Orientation, All };
constexpr Held lastOf(Held) {
  return Held::All;
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

/// Says where the members of a fleet are.
class FleetRule {
public:
  /// Of member `first` and those after it, since moveFleet() was called.
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

  /// Puts it there below its parent, which carries it from now on.
  bool setLocal(PlacementId id, const Affine& X_PN);
  /// Makes a fleet of them, which stay where they are until it moves. `rule` lives until removeFleet().
  FleetId addFleet(const FleetRule& rule, std::span<const PlacementId> members);
  /// They stay where they are.
  void removeFleet(FleetId fleet);
  /// All members but those that are claimed are elsewhere now.
  void moveFleet(FleetId fleet);
  /// visit(ids, places) for those that have moved in their fleets since the last call, a block at a time;
  /// kNoPlacement stands for members that are strays. They are shown, and stand in World.
  template <class Visit>
  void takeMovedFleets(const Visit& visit);
  bool setWorld(PlacementId id, const Affine& X_WN);  ///< the same, so that it is at X_WN now
  /// Holds it, or the part of it that is named, at X_WN until it is put below its parent again.
  bool hold(PlacementId id, const Affine& X_WN, Held part = Held::All);
  /// Puts what is held below its parent again, which was at X_WP when it was let go.
  void rejoin(PlacementId id, const Affine& X_WP);
  /// A tracker or the dynamics moves it: its fleet leaves it alone.
  void claim(PlacementId id, bool claimed);
  Held held(PlacementId id) const { return entries_[id].held; }
  const Affine& world(PlacementId id) const;
  Affine local(PlacementId id) const;  ///< where it is relative to its parent now
  /// Where its fleet puts it; nothing if it is in no fleet. The numbers are those of takeMovedFleets().
  std::optional<MemberPlace> inFleet(PlacementId id) const;
  PlacementId parent(PlacementId id) const { return entries_[id].parent; }
  bool has(PlacementId id) const { return id < entries_.size() && entries_[id].live; }
  /// What moves it when it does not move itself: its parent, or World if it is held there.
  PlacementId carrier(PlacementId id) const;

  /// Hides or shows this placement and everything below it.
  void setShown(PlacementId id, bool shown, Hider hider = Hider::Author);
  bool shown(PlacementId id) const;  ///< itself and everything above it

  /// From now on takeMovedWatched() tells when this placement moves.
  void watch(PlacementId id);
  bool anyWatched() const { return anyWatched_; }  ///< any placement, ever
  /// Whether this placement or one below it has ever been watched.
  bool watchedBelow(PlacementId id) const { return entries_[id].watchedBelow; }
  /// Those that have moved since the last call. Valid until the next one.
  const std::vector<PlacementId>& takeMovedWatched();

  /// Every other placement whose World matrix or visibility may have changed since the last call, each once.
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
    Held held = Held::Nothing;
    bool stale = false;    ///< its World matrix must be recomputed
    bool changed = false;  ///< is in changed_
    std::uint8_t hiders = 0;
    bool live = false;
    bool watched = false, watchedBelow = false;
    bool claimed = false;
    bool astray = false;       ///< a stray of some fleet
    FleetId fleet = kNoFleet;  ///< it goes with it
    std::uint32_t member = 0;
    std::uint32_t move = 0;  ///< the fleet's move after which its local matrix was written

    template <class Self, class Fields>
    static void fields(Self& e, Fields& f) {
      f("parent", e.parent), f("first child", e.firstChild);
      f("next sibling", e.nextSibling), f("previous sibling", e.previousSibling);
      f("held", e.held), f("hiders", e.hiders), f("live", e.live), f("claimed", e.claimed);
      f("watched", e.watched), f("watched below", e.watchedBelow);
      f("astray", e.astray), f("fleet", e.fleet), f("member", e.member), f("move", e.move);
    }
  };
  struct Fleet {
    const FleetRule* rule = nullptr;                            ///< null: has been removed
    std::vector<PlacementId> members;                           ///< kNoPlacement: a stray, or gone
    std::vector<std::pair<std::uint32_t, PlacementId>> strays;  ///< by number
    std::uint32_t moves = 0;
    bool moved = false;  ///< since takeMovedFleets()

    template <class Self, class Fields>
    static void fields(Self& fleet, Fields& f) {
      f("members", fleet.members), f("strays", fleet.strays), f("moves", fleet.moves);
    }
  };
  static constexpr std::size_t kFleetBlock = 64;

  /// Whether its World matrix is the local one.
  static bool standsInWorld(const Entry& e) { return e.parent == kWorldPlacement && e.held == Held::Nothing; }
  Affine carriedBy(PlacementId id, const Affine& X_WP) const;
  void markBelow(PlacementId id, bool moved);
  bool standsTogether() const;
  void settle(PlacementId id) const;
  MemberPlace memberOf(const Fleet& fleet, std::uint32_t member) const;
  void join(PlacementId id, FleetId fleet, std::uint32_t member);
  void leaveFleet(PlacementId id);
  void stray(PlacementId id);
  void putStrays(const Fleet& fleet);
  void mark(PlacementId id, Entry& e) {
    if (e.changed) return;
    e.changed = true;
    changed_.push_back(id);
  }

  mutable std::vector<Entry> entries_;
  mutable std::vector<Affine> X_PN_;  ///< by placement
  mutable std::vector<Affine> X_WN_;  ///< by placement; unused while it stands in World
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
