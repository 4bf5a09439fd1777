#pragma once
/// The bounds of a slot's instances, kept up from frame to frame at the cost of what has changed.
///
/// Threads  one at a time.

#include "pipeline/state/scene_state.h"

#include <vector>

namespace stadion {

class MovingBounds {
public:
  /// The tree of the slot as it is now; valid until the next call. Expects the same slot each time.
  BoundsTree update(const SlotView& state);
  /// Marks the tree as void, because the slot changed while it was read.
  void forget() { stamps_.clear(); }

private:
  void layOut(std::uint32_t count);
  void noteChanged(const SlotView& state);
  void refit(const SlotView& state, std::uint32_t block);

  Vec3 origin_ = Vec3::Zero();
  std::uint32_t capacity_ = 0;
  BoundsLayout layout_;
  std::vector<float> floats_;
  std::vector<std::uint32_t> stamps_;   ///< stamps of the slot at the last update
  std::vector<std::uint32_t> changed_;  ///< blocks of kInstancesAStamp
};

}  // namespace stadion
