#pragma once
/// The options of `stadion run`, in groups. Other subcommands take some of the groups.
///
/// Ownership  the options' values are written into `o`, which must stay where it is until the command line
///            has been read.

#include "cli/options/renderer_options.h"
#include "cli/options/trace_options.h"
#include "show/output/output_names.h"
#include "show/session/session_settings.h"

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace stadion {

/// The words of the command line that complete() turns into settings, and what the program itself needs of
/// them.
struct RunOptions {
  SessionSettings settings;
  std::string stereo = "pair", pace, pictures = "last";
  RendererOptions renderer;
  std::string cullDraw = "overlap", predict = "off", wallWorkers = "auto", pin = "auto", swapSync = "auto";
  TraceRequest trace;
  std::vector<double> reach{0.05, 0.25};  ///< --latch-reach [m], [rad]
  bool stereoGiven = false, cullDrawGiven = false, picturesGiven = false, degradationAsked = false,
       lateLatch = false;
  bool supervise = false;  ///< another process plays, and is replaced if it crashes
  int endsWith = -1;       ///< the process that started this one; -1: none
  bool json = false;

  /// Completes the settings. False, with the reason in the findings, if options are wrong or contradict each
  /// other.
  bool complete(Diagnostics& findings);
  /// The files that options name one by one, also those that were not asked for.
  std::vector<NamedFile> namedFiles() const;
  /// No output may be another one, or a file that the show is played from.
  void completeFiles(Diagnostics& findings) const;

private:
  /// Whether the options ask for a run that does not follow the clock.
  bool asksForEveryFrame() const;
  bool hasEnd() const;
  void completeDrawing(Diagnostics& findings);
  void completeMeasuring(Diagnostics& findings) const;
  void completeUndrawn(Diagnostics& findings) const;
  void completeLive(Diagnostics& findings);
  void completeHead(Diagnostics& findings);
  void refuseInCluster(Diagnostics& findings) const;
  void refuseInSupervision(Diagnostics& findings) const;
};

/// All of them.
void addRunOptions(CLI::App& command, RunOptions& o);

/// Where the operator's commands come from, how a group begins, sounds.
void addOperatorOptions(CLI::App& command, RunOptions& o);
void addClusterOptions(CLI::App& command, ClusterSettings& o);
void addHeadOptions(CLI::App& command, RunOptions& o);
void addLoadOptions(CLI::App& command, RunOptions& o);
/// --guard, the same in all commands that play a show.
void addGuardOption(CLI::App& command, bool& guard);
void addBlackBoxOption(CLI::App& command, RecordSettings& o);
void addSupervisionOptions(CLI::App& command, RunOptions& o);
void addTraceOptions(CLI::App& command, TraceRequest& o);
void addSpanOptions(CLI::App& command, SpanOptions& o);
void addTrackerOptions(CLI::App& command, TrackerOptions& o);

}  // namespace stadion
