#pragma once
/// How well regressions are found: slowdowns are planted and looked for, and the same is compared with
/// itself.
///
/// Threads  plain values, any thread.

#include "profiling/regression/spans/planted_delay.h"
#include "profiling/regression/spans/span_record.h"

#include <map>
#include <string>
#include <vector>

namespace stadion::regression {

/// What is done, in this order: a few of each kind in turn, so that an interrupted experiment has some of
/// all.
struct Trial {
  std::string kind;        ///< simulate, cull, draw: planted there; "nothing": a comparison with itself
  std::size_t number = 0;  ///< of its kind, from 0
  std::string name() const { return kind + " " + std::to_string(number + 1); }
};

struct TrialResult {
  std::string trial;  ///< its name
  std::string kind;
  std::string planted;              ///< "simulate:lane_07=5000"; empty: nothing
  std::vector<std::string> alarms;  ///< what was said to have moved
  std::vector<std::string> seen;    ///< of each stage: "app +4.8 %, p = 0.002"
  bool right = false;               ///< found, the right place named, and nothing else; of nothing: no alarm
  double seconds = 0;
  std::string by;         ///< what decided: instructions, times
  double share = 0;       ///< what was to be planted, of its stage [%]
  double lengthened = 0;  ///< what really was; 0 where nothing is [%]
  std::string program{};  ///< a hash of the build that was tried

  /// Whether what was planted is what was to be planted, but for a fifth: 4 to 6 % for 5 %.
  bool valid() const { return planted.empty() || (lengthened >= 0.8 * share && lengthened <= 1.2 * share); }
};

/// `planted` of each kind, `same` comparisons of the same with itself. All are played alike.
std::vector<Trial> trialsOf(std::size_t planted, std::size_t same);

/// What a frame of each stage costs, by the stage's name, and what an iteration of burn() does: in the unit
/// that decides, us or instructions.
struct StagePrices {
  std::map<std::string, double> stages;
  double iteration = 1;
};

/// What is to be planted in a trial, out of the rows of a run without anything: `share` [1] of a frame of
/// App, or of Cull or Draw of one wall. Nothing if the rows or prices have no such stage.
std::optional<PlantedDelay> plantedIn(const Trial& trial, const std::vector<SpanRow>& rows,
                                      const StagePrices& prices, double share);
/// The stage that it lengthens: "app", "cull of wall west".
std::string stageOf(const PlantedDelay& planted);
std::string toText(const PlantedDelay& planted);
/// How "moved" is told of it.
bool isNamedBy(const PlantedDelay& planted, const std::string& alarm);

std::string toJsonLine(const TrialResult& result);
std::vector<TrialResult> readTrials(const std::string& text);

/// A table of kinds with what was found beside its limit; `met`: whether all limits are.
std::string detectionTable(const std::vector<TrialResult>& results, std::size_t planted, std::size_t same,
                           bool& met);

}  // namespace stadion::regression
