#pragma once
/// The usual time of each frame of a stage, from several runs.
///
/// Threads  free functions, any thread.

#include "profiling/regression/statistics/frame_figures.h"

#include <vector>

namespace stadion::regression {

/// The usual time of a frame, and the deviation of the runs from it after each run's level is removed.
struct UsualTimes {
  std::vector<double> us;      ///< by frame: the lower quartile of the runs
  std::vector<double> levels;  ///< by run: ratio in the typical frame [1]
  double deviation = 0;        ///< median [us]

  /// Returns a run's excess over that in a frame; NaN if the run has no value.
  double excess(const StageSeries& s, std::size_t run, std::size_t frame) const;
};

UsualTimes usualTimes(const StageSeries& s);

/// Returns the value of a frame; NaN past the end.
double at(const std::vector<double>& run, std::size_t frame);

}  // namespace stadion::regression
