#pragma once
/// Finds frames that became longer although the typical frame did not. It asks two questions:
///
/// 1. The same frames: is frame n long in more runs of "now" than of "before"? A frame is long if it exceeds
///    the usual time of the same frame, in all runs of both sides, by 1, 4 or 16 ms (and by a tenth, and by
///    six times the usual deviation). The machine's own interruptions fall on other frames in each run.
/// 2. Any frames: are mean, 95th and 99th percentile, longest frame, the number of late frames, or the number
///    of long frames of a run larger than before, by more than the tolerance?
///
/// Each question is asked for processor time and for real time: four families. Each family answers for all
/// its stages, frames and figures together by a permutation test (labellings.h). It raises a false alarm with
/// probability `kHitchAlarm` at most.
///
/// Threads  free functions, any thread.

#include "profiling/regression/spans/result.h"
#include "profiling/regression/statistics/frame_figures.h"
#include "profiling/regression/statistics/labellings.h"
#include "profiling/regression/statistics/time_comparison.h"

#include <map>
#include <string>
#include <vector>

namespace stadion::regression {

constexpr double kHitchAlarm = 0.0025;  ///< alarm level of each family: 1 % together

/// The result of the first question: the same frames are longer.
struct LongFrames {
  std::vector<std::size_t> frames;
  double excessUs = 0;         ///< median excess [us]
  double before = 0, now = 0;  ///< share of the runs in which they are long [1]
  double probability = 1;      ///< probability of this result by chance, in any stage and frame
};

/// A figure of the runs is larger.
struct FigureShift {
  std::string figure;
  double before = 0, now = 0;  ///< figure of the typical run: [us], or frames
  double probability = 1;      ///< probability of this result by chance, in any stage and figure
  bool worse = false;
};

/// The result for one stage by one clock.
struct StageFrames {
  std::string stage;  ///< key of the stage
  std::string name;
  TimeKind kind = TimeKind::Processor;
  LongFrames same;
  bool hitches = false;  ///< `same` is an alarm
  std::vector<FigureShift> figures;

  bool worse() const;
};

struct HitchOptions {
  double tolerance = 0.03;  ///< tolerance of figures [1]
  double alarm = kHitchAlarm;
};

/// Expects that all series have the runs of the design. The order of the series is kept.
std::vector<StageFrames> compareFrames(const std::vector<StageSeries>& series, const RunDesign& design,
                                       const HitchOptions& options);

/// Returns the series of rounds of two builds, for stages in all rounds. `frameBudgetUs`: a longer frame is
/// late.
std::vector<StageSeries> seriesOf(const std::vector<Round>& rounds, double frameBudgetUs);
/// Returns the series of `now` for the rounds of one build.
std::vector<StageSeries> seriesOfNow(const std::vector<Round>& rounds, double frameBudgetUs);

/// Returns the figures of the typical run, by "p99 of STAGE, CLOCK [ms]" or "late frames of STAGE, CLOCK".
std::map<std::string, double> typicalFigures(const std::vector<StageSeries>& series);

/// Returns the cause of the long frames: a node of App; for the whole frame, a stage.
std::string culpritOf(const StageFrames& found, const std::vector<Round>& rounds);

/// Returns one check for each stage. `culprits`: by index of `found`.
std::vector<Check> checksOf(const std::vector<StageFrames>& found, const std::vector<std::string>& culprits,
                            const std::string& with, std::size_t rounds);

}  // namespace stadion::regression
