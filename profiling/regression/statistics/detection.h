#pragma once
/// Measures how well regressions are found: plants slowdowns and looks for them, and compares equal runs.
///
/// Threads  plain values, any thread.

#include "profiling/regression/spans/planted_delay.h"
#include "profiling/regression/spans/span_record.h"

#include <map>
#include <string>
#include <vector>

namespace stadion::regression {

/// The trials in order: a few of each kind in turn, so that an interrupted experiment has some of all.
struct Trial {
  std::string kind;        ///< simulate, cull, draw: planted there; "nothing": a comparison of equal runs
  std::size_t number = 0;  ///< number of the trial among those of its kind, from 0
  std::string name() const { return kind + " " + std::to_string(number + 1); }
};

struct TrialResult {
  std::string trial;  ///< name of the trial
  std::string kind;
  std::string planted;              ///< "simulate:lane_07=5000"; empty: nothing
  std::vector<std::string> alarms;  ///< places that were reported as slower
  std::vector<std::string> seen;    ///< results of each stage: "app +4.8 %, p = 0.002"
  bool right = false;               ///< found, the right place named, and nothing else; for "nothing": no
                                    ///< alarm
  double seconds = 0;
  std::string by;         ///< the deciding metric: instructions, times
  double share = 0;       ///< requested slowdown of its stage [%]
  double lengthened = 0;  ///< true slowdown; 0 if nothing was planted [%]
  std::string program{};  ///< a hash of the tested build

  /// Returns true if the true slowdown is within a fifth of the requested one: 4 to 6 % for 5 %.
  bool valid() const { return planted.empty() || (lengthened >= 0.8 * share && lengthened <= 1.2 * share); }
};

/// Returns `planted` trials of each kind, and `same` comparisons of equal runs. All are played alike.
std::vector<Trial> trialsOf(std::size_t planted, std::size_t same);

/// The cost of each stage's frame, by the stage's name, and of an iteration of burn(), in the deciding unit:
/// us or instructions.
struct StagePrices {
  std::map<std::string, double> stages;
  double iteration = 1;
};

/// Returns the delay for a trial, from the rows of a run without one: `share` [1] of a frame of App, or of
/// Cull or Draw of one wall. Returns nothing if the rows or prices lack that stage.
std::optional<PlantedDelay> plantedIn(const Trial& trial, const std::vector<SpanRow>& rows,
                                      const StagePrices& prices, double share);
/// Returns the stage that it lengthens: "app", "cull of wall west".
std::string stageOf(const PlantedDelay& planted);
std::string toText(const PlantedDelay& planted);
/// Returns true if the alarm names its place.
bool isNamedBy(const PlantedDelay& planted, const std::string& alarm);

std::string toJsonLine(const TrialResult& result);
std::vector<TrialResult> readTrials(const std::string& text);

/// Returns a table of kinds with results and limits; `met`: all limits are met.
std::string detectionTable(const std::vector<TrialResult>& results, std::size_t planted, std::size_t same,
                           bool& met);

}  // namespace stadion::regression
