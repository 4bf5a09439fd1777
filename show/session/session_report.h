#pragma once
/// What is known of a show when its session is over.

#include "pipeline/record/run_summary.h"
#include "profiling/report/show_figures.h"

#include <optional>
#include <string>

namespace stadion {

struct SessionReport {
  RunSummary summary{};
  Failure failure{};                     ///< the first one
  std::optional<ShowFigures> figures{};  ///< costs by node, if they were asked for
  std::string lateFrames{};              ///< how many frames were late and why; empty if none was
};

}  // namespace stadion
