#pragma once
/// Times of two builds, or of one and its baseline: finds stages that are slower by more than chance and more
/// than the tolerance, and the node responsible.
///
/// Every frame of a round is a pair: both builds do the same work in it. A round gives the difference of the
/// typical frame (the median of the ratios over its frames); the rounds are judged by their ranks. A stage
/// has become slower if two conditions hold. The probability by chance, corrected for the number of stages,
/// is at most 5 %, and the typical round differs by more than the tolerance.
///
/// Units    ratios: 0.05 is 5 % slower.
/// Threads  free functions, any thread.

#include "profiling/regression/spans/result.h"
#include "profiling/regression/spans/span_record.h"
#include "profiling/regression/statistics/frame_figures.h"
#include "profiling/regression/statistics/node_cost_comparison.h"

#include <string>
#include <utility>
#include <vector>

namespace stadion::regression {

/// The measurements of two builds in a round.
struct Round {
  std::vector<SpanRow> before, now;
};

struct StageShift {
  std::string stage;       ///< key of the stage
  std::string name;        ///< for people
  double beforeUs = 0;     ///< the typical frame [us]
  double shift = 0;        ///< shift of the typical round [1]
  double probability = 1;  ///< probability of this result by chance, corrected
  bool slower = false, faster = false;
  std::string culprit{};  ///< if slower: the node in it that changed, or that none did
  std::string unfit{};    ///< why it cannot be compared; then the figures are void
};

constexpr double kAlarm = 0.05;   ///< a probability below it is not chance
constexpr double kShortest = 10;  ///< [us]: shorter stages are not judged by the clock

/// Compares every stage that all rounds have.
std::vector<StageShift> compareRounds(const std::vector<Round>& rounds, double tolerance);
/// Times of rounds by stage, in multiples of the calibration kernel's.
using StageTimesByName = std::map<std::string, std::vector<double>>;
/// Compares rounds of one build now with those of a baseline, which are not paired. Compares every stage that
/// both have. `us`: the typical frames now.
std::vector<StageShift> compareTimes(const StageTimesByName& baseline, const StageTimesByName& now,
                                     const std::map<std::string, double>& us, double tolerance);

/// Returns the nodes' costs in the typical frame of rounds of one build, in multiples of the calibration
/// kernel's.
CostsByNode nodeTimes(const std::vector<Round>& rounds, const std::vector<double>& calibrationMs);

/// Returns checks for stages that have `metric` ("times") on one side only: they cannot be compared, and do
/// not pass.
std::vector<Check> unmatchedStages(const std::map<std::string, double>& before,
                                   const std::map<std::string, double>& now, const std::string& metric,
                                   const std::string& with);
/// Returns a check for each; a stage that cannot be compared does not pass.
std::vector<Check> checksOf(const std::vector<StageShift>& shifts, const std::string& with, double tolerance,
                            std::size_t rounds);

/// Returns true if a check failed by a probability, which another measurement can confirm.
bool isAlarm(const Check& check);
/// A failed check stays failed only if it fails in a second measurement, too; else it says that it did not.
void confirm(std::vector<Check>& checks, const std::vector<Check>& again, std::size_t rounds);

/// Returns the typical frame of each stage [us], by its name.
std::map<std::string, double> typicalStages(const std::vector<SpanRow>& rows);

/// Returns the row below stage `stage` that grew most, if it explains half of the stage's growth; else says
/// so. `cost` returns a row's cost in a run.
std::string culpritIn(const std::string& stage, const std::vector<std::pair<SpanRow, double>>& grownRows,
                      double stageGrowth);

}  // namespace stadion::regression
