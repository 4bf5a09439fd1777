#pragma once
/// A sphere that a figure never leaves.
///
/// Method   A bone whose rotation and scale no clip changes, and whose parents are such, keeps its axes: its
///          vertices move with its origin. Below any other bone everything is taken to turn freely: it stays
///          within its distance from that bone's origin. Morph targets widen what a bone carries by their
///          differences times the greatest size of their weights, each on its own. So the sphere holds for
///          each clip, each time and each blend. It is larger than each pose: culling needs no more.
/// Layers   Added layers widen it by the largest differences of the clips, so many times. A figure without them
///          has a smaller sphere.
/// Root     The origin of a root bone goes up and down where it is at rest; what hangs from it turns freely.
/// Threads  pure.

#include "engine/figure/morph.h"
#include "engine/figure/skeleton.h"

#include <optional>
#include <span>

namespace stadion {

struct ReachOptions {
  std::size_t added = 0;                ///< the most layers that are added at a time
  std::optional<std::uint32_t> root{};  ///< the bone whose way along the ground moves the node
};

/// Expects the positions (in N) and their joints to be equally many, and morphs whose vertices exist.
Sphere figureReach(const Skeleton& skeleton, std::span<const std::array<float, 3>> positions,
                   std::span<const VertexJoints> joints, std::span<const Morph> morphs = {},
                   const ReachOptions& options = {});

}  // namespace stadion
