#pragma once
/// What `stadion plan` says.
///
/// Threads  plain values.

#include "profiling/plan/costs_file.h"
#include "profiling/plan/forecast.h"

namespace stadion::plan {

struct Question {
  Plan plan;
  bool sequential = true, pipelined = true;  ///< which of them the table has
};

/// The plan's own machine: the rasteriser keeps the same part of its threads busy, of which it has one for
/// each core, 32 at most.
Machine machineWith(double cores, const ShowCosts& costs);

std::string reportText(const ShowCosts& costs, const Question& question);
/// One JSON object on one line: "costs", "plan", "forecast", "table", "remedies".
std::string reportJson(const ShowCosts& costs, const Question& question);

}  // namespace stadion::plan
