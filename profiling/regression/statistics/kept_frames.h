#pragma once
/// The frames of rounds in a baseline: the usual time of each frame, and for each round its level, its long
/// frames and its figures. That is enough for later comparisons of frames (hitch_comparison.h), and much less
/// than all frames of all rounds.
///
/// Units    multiples of the calibration kernel's time; late frames are a number of frames.
/// Threads  free functions, any thread.

#include "profiling/regression/statistics/frame_figures.h"

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace stadion::regression {

/// A stage by one clock.
struct KeptStage {
  std::vector<double> usual;                          ///< by frame: the lower quartile of the rounds
  double deviation = 0;                               ///< median deviation from it
  std::vector<double> levels;                         ///< by round, relative to the typical frame [1]
  std::vector<std::map<std::size_t, double>> longer;  ///< by round: frames with their excess
  std::vector<RunFigures> figures;                    ///< by round
};

/// By the stage's name and the clock's ("processor", "elapsed").
using KeptStages = std::map<std::string, std::map<std::string, KeptStage>>;

/// `calibrationMs`: of each run.
KeptStages keep(const std::vector<StageSeries>& series, const std::vector<double>& calibrationMs);

/// Returns the kept rounds and the present ones, kept ones first, in present units. Stages that only one side
/// has are left out.
std::vector<StageSeries> joined(const KeptStages& kept, const std::vector<StageSeries>& now,
                                const std::vector<double>& calibrationMs);
/// Returns the number of rounds kept of every stage; 0 if they differ.
std::size_t roundsIn(const KeptStages& kept);

}  // namespace stadion::regression
