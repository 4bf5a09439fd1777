#pragma once
/// Plays a show and says what its frames are spent on, node by node.

#include "profiling/report/show_figures.h"
#include "show/measure/fidelity.h"
#include "show/settings/run_options.h"
#include "show/settings/trace_options.h"

#include <optional>

namespace stadion {

struct ProfileRunOptions {
  ShowOptions show;
  std::string stereo = "pair", provider = "osmesa";
  StereoLayout layout = StereoLayout::Pair;  ///< from `stereo`
  bool drawn = true;                         ///< false: App and Cull alone
  TraceRequest trace;
  std::string html;  ///< the report's file; empty: none
  FidelityOptions fidelity;
  bool fidelityAsked = false;  ///< for the report; else if it takes seconds only
};

/// Nothing, with the findings, if something of the user's is wrong.
std::optional<ShowFigures> profileShow(const ProfileRunOptions& options, Diagnostics& findings);

}  // namespace stadion
