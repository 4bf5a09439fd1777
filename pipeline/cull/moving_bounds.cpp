#include "pipeline/cull/moving_bounds.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace stadion {
namespace {

constexpr std::uint32_t kBlock = kInstancesAStamp;
constexpr std::uint32_t kBlockLevel = 2;  ///< a box of this level holds a block
static_assert(kBlock == BoundsLayout::kWide * BoundsLayout::kWide);

/// The visitor's surroundings: a grid, so that it depends on this frame alone and seldom changes.
Vec3 originNear(const Vec3& p) {
  constexpr double kGrid = 4096;  // [m]
  return kGrid * (p / kGrid).array().round().matrix();
}

}  // namespace

/// Takes up all bounds again, with room to grow, so that this happens seldom.
void MovingBounds::layOut(std::uint32_t count) {
  capacity_ = std::max(4 * kBlock, (count + count / 2 + kBlock - 1) / kBlock * kBlock);
  layout_ = BoundsLayout(capacity_);
  floats_.assign(layout_.floats, 0);
}

void MovingBounds::noteChanged(const SlotView& state) {
  const auto blocks = static_cast<std::uint32_t>((state.instances.size() + kBlock - 1) / kBlock);
  assert(state.stamps.size() == blocks);
  const std::size_t known = stamps_.size();
  stamps_.resize(blocks);
  changed_.clear();
  for (std::uint32_t block = 0; block < blocks; ++block) {
    const std::uint32_t stamp = state.stamps[block].load(std::memory_order_acquire);
    if (block < known && stamp == stamps_[block]) continue;
    stamps_[block] = stamp;
    changed_.push_back(block);
  }
}

/// A block's spheres and the boxes of eight around them.
void MovingBounds::refit(const SlotView& state, std::uint32_t block) {
  const auto count = static_cast<std::uint32_t>(state.instances.size());
  const std::uint32_t first = block * kBlock, end = std::min(count, first + kBlock);
  for (std::uint32_t id = first; id < end; ++id) putSphere(floats_.data(), id, state.instances[id], origin_);
  putBoxes(floats_.data(), layout_, 1, first / BoundsLayout::kWide, BoundsLayout::groupsOf(end), count);
}

BoundsTree MovingBounds::update(const SlotView& state) {
  const auto count = static_cast<std::uint32_t>(state.instances.size());
  const Vec3 origin = originNear(state.viewer->rig().p);
  if (count > capacity_ || origin != origin_) {
    layOut(std::max(count, capacity_));
    origin_ = origin;
    stamps_.clear();
  }
  noteChanged(state);
  BoundsTree tree;
  tree.origin = origin_;
  tree.count = count;
  tree.floats = floats_.data();
  tree.layout = layout_;
  for (const std::uint32_t block : changed_) refit(state, block);
  BoundsTree full = tree;  // it may grow: then what is above has been kept up, too
  full.count = capacity_;
  std::uint32_t holds = 1;  // blocks to a node
  for (std::uint32_t level = kBlockLevel; level <= full.top(); ++level, holds *= BoundsLayout::kWide) {
    std::uint32_t done = ~0U;
    for (const std::uint32_t block : changed_)
      if (const std::uint32_t node = block / holds; node != done) {
        putBoxes(floats_.data(), layout_, level, node, node + 1, tree.nodes(level - 1));
        done = node;
      }
  }
  return tree;
}

}  // namespace stadion
