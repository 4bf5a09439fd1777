#pragma once
/// A case of a suite, played in child processes and compared.

#include "cli/regress/regress_options.h"
#include "profiling/regression/exact_comparison.h"
#include "profiling/regression/spans/result.h"

#include <functional>

namespace stadion {

/// One line for whoever watches.
using RegressProgress = std::function<void(const std::string&)>;

/// Plays the case in each of its modes; a result for each. What was found is put into `update`, if there is
/// one.
std::vector<regression::CaseResult> playCase(const regression::SuiteCase& c, const RegressOptions& o,
                                             const RegressReference& with, regression::Baseline* update,
                                             const std::atomic<bool>& stop, const RegressProgress& progress);

}  // namespace stadion
