#pragma once
/// The rows of `stadion bench walls` as pictures in SVG that need nothing beside them.
///
/// Threads  plain functions.

#include "profiling/bench/walls/walls_results.h"

namespace stadion::bench {

/// Frames a second and processor time beside OpenSceneGraph's best, scene by scene, with what has to be
/// reached.
std::string wallsPlot(const WallsResults& results);
/// What stages take over the number of nodes, and frames a second over the number of walls.
std::string scalingPlot(const WallsResults& results);

}  // namespace stadion::bench
