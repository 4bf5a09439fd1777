#pragma once
/// A case of a suite, played in child processes and compared.

#include "profiling/regression/exact_comparison.h"
#include "profiling/regression/spans/result.h"
#include "show/regress/regress_settings.h"

#include <atomic>
#include <functional>

namespace stadion {

/// Receives a line about what is played now.
using RegressProgress = std::function<void(const std::string&)>;

/// Plays the case in each of its modes. Returns a result for each, and adds what it found to `update`, if
/// there is one.
std::vector<regression::CaseResult> playCase(const regression::SuiteCase& c, const RegressSettings& settings,
                                             const RegressReference& with, regression::Baseline* update,
                                             const std::atomic<bool>& stop, const RegressProgress& progress);

}  // namespace stadion
