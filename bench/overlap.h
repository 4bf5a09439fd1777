#pragma once
/// Checks that the pipeline overlaps its stages: runs the real frame loop over stages that wait a fixed time
/// instead of computing.

#include "pipeline/loop/frame_loop.h"

namespace stadion {

struct OverlapTimes {
  double app = 10, cull = 8, draw = 12;  ///< [ms], cull and draw for each wall
  std::size_t walls = 4;
  std::uint64_t frames = 100;
};

/// Median time from swap to swap [ms].
double overlapPeriod(Mode mode, const OverlapTimes& times);

}  // namespace stadion
