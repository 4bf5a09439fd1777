#pragma once
/// The bounds of static records, built once. Neighbours in the tree are neighbours in the world.
///
/// Groups are found by halving at the median, along the axis on which the centres are spread most. If some
/// records are large for the space in which they lie, they are halved by size. A few huge records thus do not
/// enlarge the boxes of many small ones. (Median splits on the widest axis: Friedman, Bentley and Finkel
/// 1977.)
///
/// Memory   24 bytes a record, in one piece without pointers.
/// Threads  plain functions; the result never changes.

#include "pipeline/state/bounds_tree.h"

#include <cstddef>

namespace stadion {

/// Returns the size of the bounds of so many records [byte].
std::size_t stillBoundsBytes(std::size_t records);
/// Builds them at `memory`, aligned to 64 bytes.
void buildStillBounds(std::span<const InstanceRecord> records, std::byte* memory);
/// Returns the bounds that were built there. Reads nothing outside, even if the memory is changed meanwhile.
BoundsTree stillBounds(const std::byte* memory, std::size_t records);

}  // namespace stadion
