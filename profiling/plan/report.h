#pragma once
/// The output of `stadion plan`.
///
/// Threads  plain values.

#include "profiling/plan/costs_file.h"
#include "profiling/plan/forecast.h"

namespace stadion::plan {

struct Question {
  Plan plan;
  bool sequential = true, pipelined = true;  ///< modes in the table
};

/// Returns the plan's machine. It has a rasteriser thread for each core, 32 at most, and the same part of
/// them is busy.
Machine machineWith(double cores, const ShowCosts& costs);

std::string reportText(const ShowCosts& costs, const Question& question);
/// Returns a line with a JSON object: "costs", "plan", "forecast", "table", "remedies".
std::string reportJson(const ShowCosts& costs, const Question& question);

}  // namespace stadion::plan
