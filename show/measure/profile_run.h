#pragma once
/// Plays a show and says what its frames are spent on, node by node.

#include "profiling/report/show_figures.h"
#include "profiling/trace/trace_file.h"
#include "show/base/reporter.h"
#include "show/measure/fidelity.h"
#include "show/output/output_files.h"
#include "show/player/show_renderer.h"

#include <optional>

namespace stadion {

struct ProfileRunOptions {
  ShowOptions show;
  std::string stereo = "pair";
  StereoLayout layout = StereoLayout::Pair;  ///< from `stereo`
  RendererSettings renderer{};
  bool guard = false;  ///< writes of a stage to what it may only read end the show
  std::optional<TraceOptions> trace{};
  FidelityOptions fidelity;
  bool fidelityAsked = false;  ///< for the report; else if it takes seconds only
};

/// Returns the files that `profile --out DIR` writes: the page, the figures as JSON and CSV, and, if asked
/// for, the errors of bodies' models as JSON.
OutputFiles profileFiles(const std::string& folder, bool fidelityAsked);

/// Null, with the reason in the findings, if a file or an option is wrong, or the show could not go on, which
/// `failure` then says too. `files`: profileFiles().
std::optional<ShowFigures> profileShow(const ProfileRunOptions& options, OutputFiles& files,
                                       Reporter& reporter, Diagnostics& findings, Failure& failure);

}  // namespace stadion
