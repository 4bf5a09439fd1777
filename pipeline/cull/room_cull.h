#pragma once
/// Finds what each wall of the room may see of a frame, for all walls in one pass.
///
/// The first wall that reaches a frame searches for all walls, and the others take its result. The search
/// keeps an instance for a wall if its bounding sphere may touch the volume that the wall's views see
/// together (unionFrustum). In single precision, trees of bounds (bounds_search.h) decide the clear cases.
/// ConvexVolume decides the rest in double precision. So the result is that of a test of every record, on
/// every machine.
///
/// Threads    any, at once. A thread that comes during a search waits for its end. No thread waits for a wall
///            that does not come.
/// Ownership  a result is kept while a wall holds it. It points into the slot and its chunks, and is valid
///            while the slot is leased. If the slot was taken away, the result is void, but reading it is
///            harmless.

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

/// The part of a frame that one wall may see.
struct VisibleSet {
  bool looks = true;               ///< false: its camera is off
  std::optional<CameraView> from;  ///< where its camera stood when the room was searched
  PlacedViews placed;              ///< the wall's views at that time
  std::uint64_t tested = 0;  ///< bounds, of things and of groups, that were compared with this wall's view
  std::vector<const InstanceRecord*> records;  ///< in no particular order
};

class RoomCull {
  struct SearchedFrame;

public:
  /// Keeps the result of a search while it exists.
  class Visibility {
  public:
    Visibility(Visibility&& o) noexcept : frame_(std::exchange(o.frame_, nullptr)) {}
    Visibility& operator=(Visibility&&) = delete;
    ~Visibility();

    const VisibleSet& on(std::size_t wall) const;

  private:
    friend RoomCull;
    explicit Visibility(SearchedFrame* frame) : frame_(frame) {}
    SearchedFrame* frame_;
  };

  /// Searches for any number of walls, in their order.
  explicit RoomCull(std::vector<WallViews> walls, const BoundsKernels& kernels = bestBounds());
  ~RoomCull();

  const WallViews& wall(std::size_t number) const { return walls_[number]; }
  /// Returns what the walls may see of the frame. Expects the same choice for all walls of a frame.
  Visibility visibleIn(const SlotView& state, const EyeChoice& choice = {});
  /// Returns the owners for which the search for `wall` went down to single spheres. Searches again.
  void reached(const SlotView& state, const EyeChoice& choice, std::size_t wall,
               std::vector<NodeRef>& owners);

private:
  SearchedFrame& roomFor(const SlotView& state);
  void search(const SlotView& state, const EyeChoice& choice, SearchedFrame& frame);
  void addVolumes(std::uint32_t wall, const PlacedViews& placed);
  template <class Each>
  void eachPart(const Each& each) const;
  template <class Each>
  void eachTree(const SlotView& state, const Each& each);
  void keep(const TreeSphere& sphere, std::size_t first, const InstanceRecord& record) const;

  const std::vector<WallViews> walls_;
  std::mutex mutex_;
  /// One for each slot, and one for each slot that a lost reader still holds.
  std::vector<std::unique_ptr<SearchedFrame>> frames_;
  std::array<MovingBounds, kSlots> moving_;
  BoundsSearch bounds_;
  /// Volumes of the walls whose camera is on: one for each of their screens.
  std::vector<SearchVolume> volumes_;
  std::vector<std::uint32_t> wallsOf_;                          ///< by volume
  std::vector<std::vector<const InstanceRecord*>*> recordsOf_;  ///< by volume: the records of its wall
};

}  // namespace stadion
