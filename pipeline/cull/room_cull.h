#pragma once
/// What each wall of the room may see of a frame: found once, for all of them in one pass.
///
/// The first wall that comes to a frame searches for all; the others take what it found. An instance is kept
/// for a wall if its bounding sphere may touch what any of its views can see (unionFrustum). Trees of bounds
/// (bounds_search.h) say of most things in single precision that they surely do or surely do not; of the rest
/// ConvexVolume says so, in double precision. So the outcome is that of looking at every record, to the last
/// one, on every machine.
///
/// Threads    any, at once: a thread that comes during a search waits for its end. No thread waits for a wall
///            that does not come.
/// Ownership  what is found is kept while a wall holds it; it points into the slot and its chunks and is
///            good while the slot is under lease. Of a slot that has been taken away it is void, but can be
///            read without harm; no other thread gets it.

#include "pipeline/cull/bounds_search.h"
#include "pipeline/cull/moving_bounds.h"
#include "pipeline/state/scene_state.h"
#include "pipeline/view/wall_views.h"

#include <atomic>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

namespace stadion {

/// What one wall may see.
struct WallSeen {
  bool looks = true;               ///< false: its camera is off
  std::optional<CameraView> from;  ///< where its camera stood when the room was searched
  PlacedViews placed;              ///< its views then
  std::uint64_t tested = 0;  ///< bounds, of things and of groups, that were compared with this wall's view
  std::vector<const InstanceRecord*> records;  ///< in no particular order
};

class RoomCull {
  struct Found;

public:
  /// Holds what was found, until it goes.
  class Seen {
  public:
    Seen(Seen&& o) noexcept : found_(std::exchange(o.found_, nullptr)) {}
    Seen& operator=(Seen&&) = delete;
    ~Seen();

    const WallSeen& on(std::size_t wall) const;

  private:
    friend RoomCull;
    explicit Seen(Found* found) : found_(found) {}
    Found* found_;
  };

  /// Of any number of walls, in their order.
  explicit RoomCull(std::vector<WallViews> walls, const BoundsKernels& kernels = bestBounds());
  ~RoomCull();

  const WallViews& wall(std::size_t number) const { return walls_[number]; }
  /// Expects the same choice for all walls of a frame.
  Seen seen(const SlotView& state, const EyeChoice& choice = {});
  /// Returns the owners for which the search for `wall` went down to single spheres. Searches again.
  void reached(const SlotView& state, const EyeChoice& choice, std::size_t wall,
               std::vector<NodeRef>& owners);

private:
  Found& take(const SlotView& state);
  void lookFor(const SlotView& state, const EyeChoice& choice, Found& found);
  void addVolumes(std::uint32_t wall, const PlacedViews& placed);
  template <class Each>
  void eachPart(const Each& each) const;
  template <class Each>
  void eachTree(const SlotView& state, const Each& each);
  void keep(const TreeSphere& sphere, std::size_t first, const InstanceRecord& record) const;

  const std::vector<WallViews> walls_;
  std::mutex mutex_;
  std::vector<std::unique_ptr<Found>> found_;  ///< one a slot, and one more for each that a lost reader holds
  std::array<MovingBounds, kSlots> moving_;
  BoundsSearch search_;
  std::vector<SearchVolume> volumes_;   ///< of the walls that look: one for each of their screens
  std::vector<std::uint32_t> wallsOf_;  ///< by volume
  std::vector<std::vector<const InstanceRecord*>*> recordsOf_;  ///< of its wall, by volume
};

}  // namespace stadion
