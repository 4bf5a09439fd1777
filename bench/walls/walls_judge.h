#pragma once
/// The conditions between the rows of `stadion bench walls`, and their results.
///
/// Threads  plain functions.

#include "bench/walls/walls_case.h"
#include "bench/walls/walls_results.h"

namespace stadion::bench {

struct WallsFinding {
  enum class Kind { Met, Missed, Void };  ///< Void: nothing to compare with
  Kind kind = Kind::Void;
  std::string what;  ///< "a STRICT: frames a second, of OpenSceneGraph's (DPC)"
  double value = 0;  ///< the measured value
  double limit = 0;
  bool atLeast = true;  ///< true: the value must be at least the limit; false: at most
  std::string why{};    ///< reason if it is void
};

/// Returns OpenSceneGraph's fastest pipelined configuration, by frames a second; empty if none was measured.
std::string bestOsg(const WallsResults& results, const std::string& scene, bool flat,
                    const std::string& kind);

/// Judges the table, for the chosen scenes.
std::vector<WallsFinding> judgeTable(const WallsResults& results, const std::vector<std::string>& scenes);
/// Judges the curves: a million nodes.
std::vector<WallsFinding> judgeScaling(const WallsResults& results);

std::string textOf(const std::vector<WallsFinding>& findings);
bool noneMissed(const std::vector<WallsFinding>& findings);

}  // namespace stadion::bench
