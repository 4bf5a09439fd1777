#pragma once
/// Output of `stadion bench dynamics` for a case, and results.json.

#include "bench/comparison/comparison.h"

namespace stadion::bench {

/// Returns a table of the case's measurements and the outcome of its limits.
std::string tableOf(const CaseComparison& result);
/// Returns a line such as "27 limits met, 3 missed, 2 void", and the missed ones.
std::string summaryOf(const std::vector<CaseComparison>& results);
/// Returns all measurements and findings.
std::string resultsJson(const std::vector<CaseComparison>& results);
bool allMet(const std::vector<CaseComparison>& results);

}  // namespace stadion::bench
