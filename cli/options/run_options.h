#pragma once
/// The options of `stadion run`, group by group: other subcommands take some of the groups.
///
/// Ownership  the options' values are written into `o`, which must stay where it is until the command line has been read.

#include "show/settings/run_options.h"

namespace CLI {
class App;
}

namespace stadion {

/// All of them.
void addRunOptions(CLI::App& command, RunOptions& o);

/// Those about the operator: where commands come from, how a group begins, sounds.
void addOperatorOptions(CLI::App& command, RunOptions& o);
void addClusterOptions(CLI::App& command, RunOptions& o);
void addHeadOptions(CLI::App& command, RunOptions& o);
void addLoadOptions(CLI::App& command, RunOptions& o);
void addBlackBoxOption(CLI::App& command, RunOptions& o);
void addSupervisionOptions(CLI::App& command, RunOptions& o);
/// `option` names the trace's file: --trace or --trace-events.
void addTraceOptions(CLI::App& command, TraceRequest& o, const std::string& option);
void addSpanOptions(CLI::App& command, SpanOptions& o);
void addTrackerOptions(CLI::App& command, TrackerOptions& o);

}  // namespace stadion
