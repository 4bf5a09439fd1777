#pragma once
/// Plays a show and says what its frames are spent on, node by node.

#include "profiling/report/show_figures.h"
#include "profiling/trace/trace_file.h"
#include "show/base/reporter.h"
#include "show/measure/fidelity.h"

#include <optional>

namespace stadion {

struct ProfileRunOptions {
  ShowOptions show;
  std::string stereo = "pair", provider = "osmesa";
  StereoLayout layout = StereoLayout::Pair;  ///< from `stereo`
  bool drawn = true;                         ///< false: App and Cull alone
  bool guard = false;                        ///< writes of a stage to what it may only read end the show
  std::optional<TraceOptions> trace{};
  std::string html;  ///< the report's file; empty: none
  FidelityOptions fidelity;
  bool fidelityAsked = false;  ///< for the report; else if it takes seconds only
};

/// Null, with the reason in the findings, if a file or an option is wrong, or the show could not go on, which
/// `failure` then says too.
std::optional<ShowFigures> profileShow(const ProfileRunOptions& options, Reporter& reporter,
                                       Diagnostics& findings, Failure& failure);

}  // namespace stadion
