#pragma once
/// Finds what lies in a few volumes, in a tree of bounds: all volumes in one pass.
///
/// From the top of the tree down, a level at a time: boxes that no volume can touch are left out with all
/// they hold, and what is wholly inside a volume is not tested against it again.
///
/// Threads  one at a time; keeps its memory from search to search.

#include "engine/display/frustum.h"
#include "pipeline/cull/bounds_kernels.h"
#include "pipeline/state/bounds_tree.h"

#include <array>
#include <span>
#include <vector>

namespace stadion {

/// The fastest form of the tests on this machine.
const BoundsKernels& bestBounds();

/// A volume to search, relative to a place in World.
struct SearchVolume {
  ConvexVolume volume;
  Vec3 origin = Vec3::Zero();
};

class BoundsSearch {
public:
  static constexpr std::size_t kMostVolumes = 32;

  explicit BoundsSearch(const BoundsKernels& kernels = bestBounds()) : kernels_(kernels) {}

  /// The spheres that may touch any of the volumes. Bit v of their masks: volumes[v]. Expects at most
  /// kMostVolumes. Valid until the next search.
  std::span<const TreeSphere> find(const BoundsTree& tree, std::span<const SearchVolume> volumes);
  /// The groups of spheres to which the last search came.
  std::span<const TreeGroup> reached() const { return {now_.data(), groups_}; }
  /// Bounds tested against each volume in the last search.
  std::span<const unsigned long long, kMostVolumes> tested() const { return tested_; }

private:
  void express(const BoundsTree& tree, std::span<const SearchVolume> volumes);

  const BoundsKernels& kernels_;
  std::array<VolumePlanes, kMostVolumes> planes_;
  std::array<unsigned long long, kMostVolumes> tested_{};
  std::vector<TreeGroup> now_, next_;
  std::vector<TreeSphere> spheres_;
  unsigned groups_ = 0;
};

}  // namespace stadion
