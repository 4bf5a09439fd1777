#pragma once
/// The bounds of what stands still: built once, neighbours in the tree being neighbours in the world.
///
/// Groups are found by halving at the median, along the axis on which the centres are spread most, or by size
/// where some are large for the room they are spread over: so a few huge things do not spoil the boxes of
/// many small ones. (Median splits on the widest axis: Friedman, Bentley and Finkel 1977.)
///
/// Memory   24 bytes a record, in one piece without pointers.
/// Threads  plain functions; what is built never changes.

#include "pipeline/state/bounds_tree.h"

#include <cstddef>

namespace stadion {

/// How much the bounds of so many records take.
std::size_t stillBoundsBytes(std::size_t records);
/// Builds them at `memory`, aligned to 64 bytes.
void buildStillBounds(std::span<const InstanceRecord> records, std::byte* memory);
/// What has been built there. Reads nothing outside, whatever stands there meanwhile.
BoundsTree stillBounds(const std::byte* memory, std::size_t records);

}  // namespace stadion
