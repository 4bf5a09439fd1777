#pragma once
/// What `stadion bench dynamics` says of a case, and results.json.

#include "profiling/bench/comparison/comparison.h"

namespace stadion::bench {

/// A table of the case's measurements and what has become of its limits.
std::string tableOf(const CaseResult& result);
/// "27 limits met, 3 missed, 2 void" and which were missed.
std::string summaryOf(const std::vector<CaseResult>& results);
/// All measurements and findings.
std::string resultsJson(const std::vector<CaseResult>& results);
bool allMet(const std::vector<CaseResult>& results);

}  // namespace stadion::bench
