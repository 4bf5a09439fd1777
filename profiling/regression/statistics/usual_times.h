#pragma once
/// What each frame of a stage usually takes, out of several runs.
///
/// Threads  free functions, any thread.

#include "profiling/regression/statistics/frame_figures.h"

#include <vector>

namespace stadion::regression {

/// What a frame usually takes, and how far the runs are from it once each is freed of its own level.
struct UsualTimes {
  std::vector<double> us;      ///< by frame: the lower quartile of the runs
  std::vector<double> levels;  ///< by run: how it compares in the typical frame [1]
  double deviation = 0;        ///< in the middle [us]

  /// By how much a run exceeds that in a frame; not a number if it does not tell.
  double excess(const StageSeries& s, std::size_t run, std::size_t frame) const;
};

UsualTimes usualTimes(const StageSeries& s);

/// The value of a frame; not a number past the end.
double at(const std::vector<double>& run, std::size_t frame);

}  // namespace stadion::regression
