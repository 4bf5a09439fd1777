#pragma once
/// The frames of rounds as a baseline keeps them: what each frame usually takes, and in each round its level,
/// its long frames and its figures. That is enough to compare frames with later (hitch_comparison.h), and
/// much less than all frames of all rounds.
///
/// Units    multiples of the calibration kernel's time; late frames are a number of frames.
/// Threads  free functions, any thread.

#include "profiling/regression/statistics/frame_figures.h"

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace stadion::regression {

/// Of a stage by one clock.
struct KeptStage {
  std::vector<double> usual;                          ///< by frame: the lower quartile of the rounds
  double deviation = 0;                               ///< from it, in the middle
  std::vector<double> levels;                         ///< by round, in the typical frame [1]
  std::vector<std::map<std::size_t, double>> longer;  ///< by round: frames that take so much longer
  std::vector<RunFigures> figures;                    ///< by round
};

/// By the stage's name and the clock's ("processor", "elapsed").
using KeptStages = std::map<std::string, std::map<std::string, KeptStage>>;

/// `calibrationMs`: of each run.
KeptStages keep(const std::vector<StageSeries>& series, const std::vector<double>& calibrationMs);

/// The kept rounds and those of now side by side, kept ones first, in the units of now; stages of which only
/// one side tells are left out.
std::vector<StageSeries> joined(const KeptStages& kept, const std::vector<StageSeries>& now,
                                const std::vector<double>& calibrationMs);
/// How many rounds are kept of every stage; 0 if they do not agree.
std::size_t roundsIn(const KeptStages& kept);

}  // namespace stadion::regression
