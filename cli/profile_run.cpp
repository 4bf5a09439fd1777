#include "cli/profile_run.h"

#include "cli/show_recording.h"
#include "cli/stop_signal.h"
#include "pipeline/output/progress.h"

#include <cstdio>

namespace stadion {
namespace {

constexpr std::uint64_t kFramesWithoutInput = 600;

}  // namespace

std::optional<ShowFigures> profileShow(const ProfileRunOptions& options, Diagnostics& findings) {
  const std::atomic<bool>& stop = catchStopSignals();
  std::unique_ptr<GlProvider> provider;
  if (options.drawn) {
    auto opened = openGlProvider(options.provider == "egl" ? GlProviderKind::Egl : GlProviderKind::OsMesa);
    if (!opened) return findings.add(opened.error()), std::nullopt;
    provider = std::move(opened.value());
  }
  const auto player = Player::create(options.show, findings, tell, &stop);
  if (!player) return {};
  FrameLoopOptions loopOptions = player->loopOptions();
  if (loopOptions.frames == 0 && loopOptions.end == 0) loopOptions.frames = kFramesWithoutInput;

  const auto recording = ShowRecording::create({}, findings);
  if (!recording) return {};
  ProgressBar progress(loopOptions.frames);
  const ShowStages* running = nullptr;
  ShowParts parts = player->parts(options.layout);
  parts.provider = provider.get();
  parts.probe = &recording->probe();
  parts.observer = [&](const TimeSignature& now, const InputSample&, const Scene& scene) {
    recording->see(scene);
    player->collect(running->shownFrame());
    progress.update(now.frame + 1);
  };
  ShowStages stages(std::move(parts));
  running = &stages;
  FrameLoop loop(stages, loopOptions, stop, &recording->probe());
  const FrameLoopOutcome outcome = loop.run();
  progress.finish();
  if (outcome.failure) return findings.error({}, outcome.failure->message), std::nullopt;
  if (recording->lost() > 0)
    findings.warning({}, std::to_string(recording->lost()) + " spans were lost: they came faster than they "
                                                             "could be collected");
  return recording->figures(player->walls().names(), options.provider != "egl");
}

}  // namespace stadion
