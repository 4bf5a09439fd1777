#pragma once
/// Plays a show and says what its frames are spent on, node by node.

#include "cli/run_options.h"
#include "profiling/show_figures.h"

#include <optional>

namespace stadion {

struct ProfileRunOptions {
  ShowOptions show;
  std::string stereo = "pair", provider = "osmesa";
  StereoLayout layout = StereoLayout::Pair;  ///< from `stereo`
  bool drawn = true;                         ///< false: App and Cull alone
};

/// Nothing, with the findings, if something of the user's is wrong.
std::optional<ShowFigures> profileShow(const ProfileRunOptions& options, Diagnostics& findings);

}  // namespace stadion
