#pragma once
/// What `run` says and writes when the show is over.

#include "pipeline/record/run_summary.h"
#include "show/cluster/cluster_part.h"
#include "show/session/run_watch.h"
#include "show/session/show_recording.h"
#include "show/settings/run_options.h"

#include <map>
#include <string>

namespace stadion {

/// A run that is over.
struct FinishedRun {
  const RunOptions& options;
  Player& player;
  const ShowStages& stages;
  const FrameLoop& loop;
  const FrameLoopOutcome& outcome;
  RunWatch& watch;
  double elapsed;  ///< [s]
  std::uint64_t groups = 1;
  double uptime = 0;                     ///< of all groups [s]
  ShowRecording* recording = nullptr;    ///< null: nobody looked where frames go
  std::map<std::string, double> work{};  ///< what was counted, if it was asked for
  const DrawingPlan* drawing = nullptr;  ///< null: nothing was drawn
  const ClusterPart* cluster = nullptr;  ///< null: one machine played it
  std::string remark{};                  ///< what else is to be known of it
};

/// Completes every file and tells how it went. Returns the exit code. `output` and its folder: null without
/// --out.
int report(const FinishedRun& run, RunOutput* output, OutputFolder* folder);

/// Which nodes cost the most, if it was asked for, and why frames were late, on stderr. False, and told, if
/// the trace could not be written. `gl`: who drew, as describeGl() says it.
bool tellRecording(const RunOptions& options, ShowRecording& recording, const Player& player,
                   const std::string& gl);

}  // namespace stadion
