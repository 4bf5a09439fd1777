#pragma once
/// Where every movable thing is: a tree of placements in flat arrays.
///
/// A placement has a local matrix relative to its parent and, from that, a World matrix. What something
/// outside the tree moves, a tracker or the dynamics, is held in World instead: its parent does not carry it,
/// so that it does not matter which of the two moves first. Nothing is recomputed unless it or something
/// above it moved. World matrices may be asked for at any time in App and are always up to date.
///
/// Frames   X_PN maps Node to Parent coordinates, X_WN Node to World.
/// Threads  App only; other stages see published instance records.
/// Errors   a non-finite matrix is refused: the setter returns false and keeps the old one.

#include "engine/maths/maths.h"
#include "engine/prefetch.h"

#include <cstdint>
#include <span>
#include <vector>

namespace stadion {

using PlacementId = std::uint32_t;
constexpr PlacementId kWorldPlacement = 0;  ///< World itself: the identity, never moves
constexpr PlacementId kNoPlacement = ~PlacementId{0};

/// Who hides something: it is shown while nobody does.
enum class Hider : std::uint8_t {
  Author = 1,  ///< the script, and its messages
  Level = 2,   ///< an lod node above it draws another child
  Relief = 4,  ///< it costs too much
};

/// What of a placement is held in World.
enum class Held : std::uint8_t { Nothing, Position, Orientation, All };

class Placements {
public:
  Placements();

  PlacementId add(PlacementId parent, const Affine& X_PN);
  /// Expects that its children are gone.
  void remove(PlacementId id);

  /// Puts it there below its parent, which carries it from now on.
  bool setLocal(PlacementId id, const Affine& X_PN);
  /// The same for many that one node moves: put(i, X_PN) says where ids[i] is now. Leaves out what is
  /// claimed. Expects finite matrices.
  template <class Put>
  void setLocals(std::span<const PlacementId> ids, const Put& put);
  static constexpr std::size_t kAhead = 8;  ///< so many placements before its turn memory is asked for
  bool setWorld(PlacementId id, const Affine& X_WN);  ///< the same, so that it is at X_WN now
  /// Holds it, or the part of it that is named, at X_WN until it is put below its parent again.
  bool hold(PlacementId id, const Affine& X_WN, Held part = Held::All);
  /// Puts what is held below its parent again, which was at X_WP when it was let go.
  void rejoin(PlacementId id, const Affine& X_WP);
  /// A tracker or the dynamics moves it: setLocals() leaves it alone.
  void claim(PlacementId id, bool claimed) { entries_[id].claimed = claimed; }
  Held held(PlacementId id) const { return entries_[id].held; }
  const Affine& world(PlacementId id) const;
  Affine local(PlacementId id) const;  ///< where it is relative to its parent now
  PlacementId parent(PlacementId id) const { return entries_[id].parent; }
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

  /// Every placement whose World matrix or visibility may have changed since the last call, each once. Valid
  /// until the next one.
  const std::vector<PlacementId>& takeChanged();

private:
  /// Kept apart from the matrices: who looks for one thing in many placements reads little.
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
  };

  /// Whether its World matrix is the local one.
  static bool standsInWorld(const Entry& e) { return e.parent == kWorldPlacement && e.held == Held::Nothing; }
  Affine carriedBy(PlacementId id, const Affine& X_WP) const;
  void markBelow(PlacementId id, bool moved);
  void mark(PlacementId id, Entry& e) {
    if (e.changed) return;
    e.changed = true;
    changed_.push_back(id);
  }

  mutable std::vector<Entry> entries_;
  std::vector<Affine> X_PN_;          ///< by placement
  mutable std::vector<Affine> X_WN_;  ///< by placement; unused while it stands in World
  std::vector<Affine> X_WH_;          ///< by placement: where it is held
  bool anyWatched_ = false;
  std::vector<PlacementId> free_;
  std::vector<PlacementId> changed_, movedWatched_;
  std::vector<PlacementId> changedTold_, movedTold_;
  mutable std::vector<PlacementId> chain_;  ///< world()'s own
};

template <class Put>
void Placements::setLocals(std::span<const PlacementId> ids, const Put& put) {
  for (std::size_t i = 0; i < ids.size(); ++i) {
    const PlacementId id = ids[i];
    if (i + kAhead < ids.size()) {
      prefetch(&entries_[ids[i + kAhead]]);
      prefetch(&X_PN_[ids[i + kAhead]]);
    }
    Entry& e = entries_[id];
    if (e.claimed) continue;
    put(i, X_PN_[id]);
    e.held = Held::Nothing;
    if (e.firstChild != kNoPlacement || e.watched) {
      markBelow(id, true);
      continue;
    }
    e.stale = true;
    mark(id, e);
  }
}

}  // namespace stadion
