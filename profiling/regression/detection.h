#pragma once
/// How well regressions are found: slowdowns are planted and looked for, and the same is compared with
/// itself.
///
/// Threads  plain values, any thread.

#include "profiling/regression/planted_delay.h"
#include "profiling/regression/span_record.h"

#include <map>
#include <string>
#include <vector>

namespace stadion::regression {

/// What is done, in this order: a few of each kind in turn, so that an interrupted experiment has some of
/// all.
struct Trial {
  std::string kind;        ///< simulate, cull, draw: planted there; "nothing": a comparison with itself
  std::size_t number = 0;  ///< of its kind, from 0
  bool drawn = false;      ///< whether the comparison is about Draw as well
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
};

/// `planted` of each kind, `same` comparisons of the same with itself, of which one in three is drawn, as of
/// the planted ones.
std::vector<Trial> trialsOf(std::size_t planted, std::size_t same);

/// What is to be planted in a trial, out of what a run without anything cost: `share` [1] of the typical
/// frame of App, or of Cull or Draw of one wall. `nsPerIteration`: of burn(). Nothing if the rows have no
/// such stage.
std::optional<PlantedDelay> plantedIn(const Trial& trial, const std::vector<SpanRow>& rows, double share,
                                      double nsPerIteration);
std::string toText(const PlantedDelay& planted);
/// How "moved" is told of it.
bool isNamedBy(const PlantedDelay& planted, const std::string& alarm);

/// Processor time of an iteration of burn() [ns].
double burnNanoseconds();

std::string toJsonLine(const TrialResult& result);
std::vector<TrialResult> readTrials(const std::string& text);

/// A table of kinds with what was found beside its limit; `met`: whether all limits are.
std::string detectionTable(const std::vector<TrialResult>& results, std::size_t planted, std::size_t same,
                           bool& met);

}  // namespace stadion::regression
