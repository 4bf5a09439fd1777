#pragma once
/// The rows of `stadion bench walls` as self-contained SVG pictures.
///
/// Threads  plain functions.

#include "bench/walls/walls_results.h"

namespace stadion::bench {

/// Frames a second and processor time beside OpenSceneGraph's best, scene by scene, with the limits.
std::string wallsPlot(const WallsResults& results);
/// Durations of stages over the number of nodes, and frames a second over the number of walls.
std::string scalingPlot(const WallsResults& results);

}  // namespace stadion::bench
