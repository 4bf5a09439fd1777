#pragma once
/// Runs the cases on all engines, interleaved: round by round, case by case, engine by engine. Other load on
/// the machine then affects all alike.

#include "bench/comparison/engine_program.h"
#include "bench/comparison/verdict.h"

#include <functional>

namespace stadion::bench {

struct ComparisonOptions {
  std::vector<std::string> cases;  ///< parts of their names; empty: all
  bool everyStep = false;          ///< the peers at all steps a frame, not just 1 and 4
  int rounds = 3;
  int limit = 30;  ///< [s] of processor time for one case on one engine
};

struct CaseComparison {
  std::string name;
  std::vector<Measurement> measurements;  ///< medians, Stadion first
  Verdict verdict;                        ///< points into the measurements
};

/// Returns the names in `options.cases` that are part of no case's name.
std::vector<std::string> unknownCases(const ComparisonOptions& options, const std::vector<ListedCase>& known);

/// Calls `done` for each case when its last round is over.
void compareEngines(const std::vector<EngineProgram>& programs, const ComparisonOptions& options,
                    const std::function<void(const std::string& progress)>& progress,
                    const std::function<void(const CaseComparison&)>& done);

}  // namespace stadion::bench
