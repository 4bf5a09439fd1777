#include "show/measure/calibrate_measure.h"

#include "pipeline/platform/topology.h"
#include "pipeline/target/rasteriser_settings.h"
#include "profiling/record/processor_time.h"
#include "show/measure/calibration_show.h"
#include "show/player/player.h"

#include <atomic>
#include <chrono>

namespace stadion {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::uint64_t kWarmFrames = 2, kLeast = 3;  // frames
constexpr std::uint64_t kMost = 1'000'000;

/// Ends the run when it has been looked at for long enough.
class Watch {
public:
  explicit Watch(double seconds) : seconds_(seconds) {}

  void frameShown() {
    ++frames_;
    if (frames_ == kWarmFrames) {
      begin_ = Clock::now();
      processorBegin_ = processorSeconds();
    }
    if (frames_ < kWarmFrames + kLeast || enough_) return;
    const double took = std::chrono::duration<double>(Clock::now() - begin_).count();
    if (took < seconds_) return;
    const auto frames = static_cast<double>(frames_ - kWarmFrames);
    figures_.framesPerSecond = frames / took;
    figures_.cpuMs = 1e3 * (processorSeconds() - processorBegin_) / frames;
    enough_ = true;
  }

  const std::atomic<bool>& enough() const { return enough_; }
  const CalibrationFigures& figures() const { return figures_; }

private:
  const double seconds_;
  std::uint64_t frames_ = 0;
  Clock::time_point begin_{};
  double processorBegin_ = 0;
  CalibrationFigures figures_;
  std::atomic<bool> enough_ = false;
};

ShowOptions showOf(const CalibrationRun& run) {
  ShowOptions show;
  show.script = calibrationScript(run.folder);
  show.walls = run.walls;
  show.size = run.size;
  show.look = run.look;
  show.input = "none";
  show.frames = kMost;
  return show;
}

}  // namespace

Result<CalibrationFigures> measureSetting(const CalibrationRun& run, Diagnostics& findings) {
  using Measured = Result<CalibrationFigures>;
  setRasteriserThreads(run.setting.rasteriserThreads);
  ShowOptions show = showOf(run);
  const auto failed = [](const std::string& what) { return Measured::failure(what); };
  if (!show.complete(findings)) return failed("bad settings");
  auto provider = openGlProvider(GlProviderKind::OsMesa);
  if (!provider) return provider.error();
  const auto player = Player::create(show, findings);
  if (!player) return failed("the show cannot be played");
  Watch watch(run.seconds);
  ShowParts parts = player->parts(StereoLayout::Pair);
  parts.provider = provider.value().get();
  parts.shown = [&] { watch.frameShown(); };
  if (run.setting.processes) {
    WallProcesses wallProcesses;
    wallProcesses.rasteriserThreads = run.setting.rasteriserThreads;
    parts.wallProcesses = wallProcesses;
  }
  if (run.setting.pinned) parts.processors = Topology::ofThisMachine().parts(parts.walls.size());
  // As canDraw() does in a run: the rasteriser's threads start here, on all processors.
  const WallViews& wall = parts.walls.front();
  if (!run.setting.processes)
    if (auto why = checkPictureSize(*provider.value(), wall.width, wall.height)) return *why;
  ShowStages stages(std::move(parts));
  FrameLoop loop(stages, player->loopOptions(), watch.enough());
  if (const FrameLoopOutcome outcome = loop.run(); outcome.failure) return failed(outcome.failure->message);
  CalibrationFigures figures = watch.figures();
  figures.rasteriser = stages.drawnBy();
  return figures;
}

}  // namespace stadion
