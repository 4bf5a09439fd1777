#pragma once
/// What has to hold between the rows of `stadion bench walls`, and whether it does.
///
/// Threads  plain functions.

#include "profiling/bench/walls/walls_case.h"
#include "profiling/bench/walls/walls_results.h"

namespace stadion::bench {

struct WallsFinding {
  enum class Kind { Met, Missed, Void };  ///< Void: nothing to compare with
  Kind kind = Kind::Void;
  std::string what;  ///< "a STRICT: frames a second, of OpenSceneGraph's (DPC)"
  double value = 0;  ///< of what was measured
  double limit = 0;
  bool atLeast = true;  ///< else at most
  std::string why{};    ///< why it is void
};

/// OpenSceneGraph's fastest configuration of the pipelined ones, by frames a second; empty if none was
/// measured.
std::string bestOsg(const WallsResults& results, const std::string& scene, bool flat,
                    const std::string& kind);

/// The lines of the table, for the scenes that were chosen.
std::vector<WallsFinding> judgeTable(const WallsResults& results, const std::vector<std::string>& scenes);
/// Those of the curves: a million nodes.
std::vector<WallsFinding> judgeScaling(const WallsResults& results);

std::string textOf(const std::vector<WallsFinding>& findings);
bool noneMissed(const std::vector<WallsFinding>& findings);

}  // namespace stadion::bench
