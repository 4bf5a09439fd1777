#pragma once
/// What a suite has found as a page for a browser: nothing beside the file is needed, no script, no network.

#include "profiling/regression/spans/result.h"
#include "profiling/regression/statistics/history.h"

#include <string>
#include <vector>

namespace stadion::regression {

/// `history`: with this run as its last entry.
std::string pageOf(const SuiteResult& result, const std::vector<HistoryEntry>& history);

}  // namespace stadion::regression
