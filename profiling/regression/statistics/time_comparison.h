#pragma once
/// Times of two builds, or of one and its baseline: is a stage slower by more than chance and more than the
/// tolerance, and which node is it?
///
/// Every frame of a round is a pair: both builds do the same work in it. A round says by how much the typical
/// frame differs (the median of the ratios over its frames); the rounds are judged by their ranks. A stage
/// has become slower if the probability of that by chance, corrected for the number of stages, is at most 5
/// %, and the typical round differs by more than the tolerance.
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

/// What one round told of two builds.
struct Round {
  std::vector<SpanRow> before, now;
};

struct StageShift {
  std::string stage;       ///< its key
  std::string name;        ///< for people
  double beforeUs = 0;     ///< the typical frame [us]
  double shift = 0;        ///< of the typical round [1]
  double probability = 1;  ///< of as much by chance, corrected
  bool slower = false, faster = false;
  std::string culprit{};  ///< if slower: the node in it that moved, or that none did
  std::string unfit{};    ///< why it cannot be compared; then the figures are void
};

constexpr double kAlarm = 0.05;   ///< probability below which it is no chance
constexpr double kShortest = 10;  ///< [us]: what takes less is not judged by the clock

/// Of every stage that all rounds told of.
std::vector<StageShift> compareRounds(const std::vector<Round>& rounds, double tolerance);
/// Times of rounds by stage, in multiples of the calibration kernel's.
using StageTimesByName = std::map<std::string, std::vector<double>>;
/// The same of rounds of one build now, and of those that a baseline has kept: not paired. Of every stage
/// that both tell of. `us`: the typical frames now.
std::vector<StageShift> compareTimes(const StageTimesByName& baseline, const StageTimesByName& now,
                                     const std::map<std::string, double>& us, double tolerance);

/// What the nodes of rounds of one build cost in the typical frame, in multiples of the calibration kernel's.
CostsByNode nodeTimes(const std::vector<Round>& rounds, const std::vector<double>& calibrationMs);

/// Stages of whose `metric` ("times") only one side tells: nothing can be compared, and that is no pass.
std::vector<Check> unmatchedStages(const std::map<std::string, double>& before,
                                   const std::map<std::string, double>& now, const std::string& metric,
                                   const std::string& with);
/// A check for each; what cannot be compared is no pass.
std::vector<Check> checksOf(const std::vector<StageShift>& shifts, const std::string& with, double tolerance,
                            std::size_t rounds);

/// Whether a check failed by a probability, which another measurement can confirm.
bool isAlarm(const Check& check);
/// What failed stays failed only if it fails in a second measurement, too; else says that it did not.
void confirm(std::vector<Check>& checks, const std::vector<Check>& again, std::size_t rounds);

/// The typical frame of each stage [us], by its name.
std::map<std::string, double> typicalStages(const std::vector<SpanRow>& rows);

/// The row below stage `stage` whose cost grew the most, if that explains half of what the stage grew by;
/// else says so. `cost` is of a row in a run.
std::string culpritIn(const std::string& stage, const std::vector<std::pair<SpanRow, double>>& grownRows,
                      double stageGrowth);

}  // namespace stadion::regression
