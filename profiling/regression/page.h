#pragma once
/// The results of a suite as a self-contained page for a browser: no other files, no script, no network.

#include "profiling/regression/spans/result.h"
#include "profiling/regression/statistics/history.h"

#include <string>
#include <vector>

namespace stadion::regression {

/// `history`: this run is its last entry.
std::string pageOf(const SuiteResult& result, const std::vector<HistoryEntry>& history);

}  // namespace stadion::regression
