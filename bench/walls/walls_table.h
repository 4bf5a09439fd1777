#pragma once
/// The table of `stadion bench walls` for people.
///
/// Threads  plain functions.

#include "bench/walls/walls_results.h"

namespace stadion::bench {

/// A line for each case: medians over the rounds, and ratios to OpenSceneGraph's best.
std::string tableOf(const WallsResults& results);
/// The differences of the pictures, a line for each comparison.
std::string picturesOf(const WallsResults& results);

}  // namespace stadion::bench
