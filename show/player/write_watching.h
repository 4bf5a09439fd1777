#pragma once
/// `--guard`: watches the stages of a run for writes to what they may only read.
///
/// Threads  before the frame loop runs, and after it has ended.

#include "pipeline/loop/show_stages.h"
#include "pipeline/loop/write_watch.h"
#include "pipeline/record/run_summary.h"

#include <map>
#include <memory>
#include <string>

namespace stadion {

struct FrameLoopOptions;

/// Null if `asked` is false. The watch must go after the loop has ended, and before the scene state.
std::unique_ptr<WriteWatch> watchWrites(bool asked, const ShowParts& parts, FrameLoopOptions& options);
/// Returns figures for a summary by name. Expects a watch, and the durations of App [ms].
std::map<std::string, double> costOfWatch(const SampleStatistics& app);
/// Adds to the message the name of the node that it is about, if there is one.
void nameNode(Failure& failure, const Scene& scene);

}  // namespace stadion
