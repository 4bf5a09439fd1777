#include "show/player/write_watching.h"

#include "pipeline/loop/frame_loop.h"
#include "pipeline/state/guard_cost.h"
#include "profiling/record/node_names.h"

#include <fmt/format.h>

#include <cmath>

namespace stadion {
namespace {

/// To four decimals.
double rounded(double value) {
  return std::round(1e4 * value) / 1e4;
}

}  // namespace

std::unique_ptr<WriteWatch> watchWrites(bool asked, const ShowParts& parts, FrameLoopOptions& options) {
  if (!asked) return nullptr;
  auto watch = std::make_unique<WriteWatch>(parts.state, parts.walls.size());
  options.watch = watch.get();
  return watch;
}

std::map<std::string, double> costOfWatch(const SampleStatistics& app) {
  const GuardCost cost = costOfGuard();
  const double each = app.count > 0 ? cost.milliseconds / static_cast<double>(app.count) : 0.0;
  const double appMs = app.mean * static_cast<double>(app.count);
  return {
      {"guard: protect calls", static_cast<double>(cost.calls)},
      {"guard: protect calls, ms a frame", rounded(each)},
      {"guard: protect calls, percent of App", rounded(appMs > 0 ? 100 * cost.milliseconds / appMs : 0.0)}};
}

void nameNode(Failure& failure, const Scene& scene) {
  if (!failure || !failure->node.valid()) return;
  NodeNames names;
  names.see(scene);
  if (const auto node = names.find(failure->node))
    failure->message += fmt::format(", of {} ({}:{})", node->path, node->file, node->line);
}

}  // namespace stadion
