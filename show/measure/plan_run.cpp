#include "show/measure/plan_run.h"

#include "engine/maths/median.h"
#include "pipeline/draw_list/draw_list.h"
#include "show/base/stop_signal.h"

#include <algorithm>
#include <fstream>

namespace stadion {
namespace {

/// The last ones: those before are not looked at.
double middleOfLast(const std::vector<double>& values, std::size_t count) {
  const std::size_t from = values.size() > count ? values.size() - count : 0;
  return median({values.begin() + static_cast<std::ptrdiff_t>(from), values.end()});
}

/// Plays it once; false, with the findings, if that cannot be.
bool play(const PlanRunOptions& options, Mode mode, ShowRenderer& renderer, Reporter& reporter,
          plan::CostProbe* probe, Diagnostics& findings, FrameTimes& times) {
  const std::atomic<bool>& stop = catchStopSignals();
  ShowOptions show = options.show;
  show.frames += kFramesBefore;
  const auto player = Player::create(show, findings, reporter.reportFunction(), &stop);
  if (!player) return false;
  FrameLoopOptions loopOptions = player->loopOptions();
  loopOptions.mode = mode;
  loopOptions.walls = options.walls;
  ShowParts parts = player->parts(options.layout);
  parts.walls.resize(options.walls);
  if (options.processes && !probe)
    parts.wallProcesses = {.renderer = renderer.kind(), .rasteriserThreads = 1, .rate = player->rate()};
  renderer.drawFor(parts);
  std::optional<DrawPool> measured;  // what its threads share is not mixed with what Draw does itself
  if (probe && parts.pool) parts.pool = &measured.emplace(parts.pool->threads(), DrawPool::Callers::Wait);
  parts.probe = probe;
  ShowStages stages(std::move(parts));
  FrameLoop loop(stages, loopOptions, stop, probe);
  const FrameLoopOutcome outcome = loop.run();
  if (outcome.failure) findings.error({}, outcome.failure->message);
  times = loop.times();
  return !outcome.failure && !outcome.stopped;
}

}  // namespace

double loadNow() {
  double load = 0;
  std::ifstream("/proc/loadavg") >> load;
  return load;
}

bool measureCosts(const PlanRunOptions& options, ShowRenderer& renderer, Reporter& reporter,
                  MeasuredCosts& costs, Diagnostics& findings) {
  plan::CostProbe probe(options.walls, kFramesBefore, DrawList::kPortion);
  FrameTimes times(options.walls);
  if (!play(options, Mode::Sequential, renderer, reporter, &probe, findings, times)) return false;
  costs.runs.push_back(probe.costs());
  costs.waitsInTurn = renderer.drawsWithGl() && probe.waitsInTurn();
  return true;
}

std::optional<PlayedTimes> playTimes(const PlanRunOptions& options, Mode mode, ShowRenderer& renderer,
                                     Reporter& reporter, Diagnostics& findings) {
  FrameTimes times(options.walls);
  if (!play(options, mode, renderer, reporter, nullptr, findings, times)) return {};
  const std::size_t frames = options.show.frames;
  return PlayedTimes{middleOfLast(times.period.values(), frames - 1),
                     middleOfLast(times.latency.front().values(), frames)};
}

}  // namespace stadion
