#include "show/measure/profile_run.h"

#include "engine/base/atomic_file.h"
#include "show/base/stop_signal.h"
#include "show/measure/profile_report.h"
#include "show/player/write_watching.h"
#include "show/recording/last_frames.h"
#include "show/recording/show_recording.h"

#include <fmt/format.h>

namespace stadion {
namespace {

constexpr std::uint64_t kProfiledWithoutInput = 600;

constexpr std::uint64_t kUnrecorded = FrameLogOptions{}.from;

std::string tooShort(const std::string& played) {
  return played + ", and none was recorded: the first " + std::to_string(kUnrecorded) +
         " are not, for what is touched for the first time is slow; play at least " +
         std::to_string(kUnrecorded + 1) + ", better some hundreds: --frames " +
         std::to_string(kProfiledWithoutInput);
}

std::unique_ptr<ShowRecording> record(const ProfileRunOptions& options, const Player& player,
                                      Diagnostics& findings) {
  RecordingOptions recorded;
  const std::vector<std::string> walls = player.walls().names();
  recorded.trace = options.trace;
  if (recorded.trace) recorded.trace->show = options.show.script, recorded.trace->walls = walls;
  recorded.keep = unaskedLastFrames(walls);
  if (!options.html.empty()) recorded.report = RecordingOptions::Report{player.rate(), walls};
  return findings.hasErrors() ? nullptr : ShowRecording::create(std::move(recorded), findings);
}

}  // namespace

std::optional<ShowFigures> profileShow(const ProfileRunOptions& options, Reporter& reporter,
                                       Diagnostics& findings, Failure& failure) {
  const std::atomic<bool>& stop = catchStopSignals();
  std::unique_ptr<GlProvider> provider;
  if (options.drawn) {
    auto opened = openGlProvider(options.provider == "egl" ? GlProviderKind::Egl : GlProviderKind::OsMesa);
    if (!opened) return findings.add(opened.error()), std::nullopt;
    provider = std::move(opened.value());
  }
  const auto player = Player::create(options.show, findings, reporter.reportFunction(), &stop);
  if (!player) return {};
  FrameLoopOptions loopOptions = player->loopOptions();
  if (loopOptions.frames == 0 && loopOptions.end == 0) loopOptions.frames = kProfiledWithoutInput;

  if (loopOptions.frames > 0 && loopOptions.frames <= kUnrecorded)
    return findings.error({}, tooShort("too few frames: " + std::to_string(loopOptions.frames))),
           std::nullopt;

  // Files are opened before anything is played.
  std::optional<AtomicFile> html;
  if (!options.html.empty() && html.emplace(options.html).error()) findings.add(*html->error());
  const auto recording = record(options, *player, findings);
  if (!recording || findings.hasErrors()) return {};
  const ShowStages* running = nullptr;
  ShowParts parts = player->parts(options.layout);
  parts.provider = provider.get();
  parts.probe = &recording->probe();
  parts.observer = [&](const TimeSignature& now, const InputSample&, const Scene& scene) {
    recording->see(scene);
    player->collect(running->shownFrame());
    reporter.progress(now.frame + 1, loopOptions.frames);
  };
  const auto watch = watchWrites(options.guard, parts, loopOptions);
  ShowStages stages(std::move(parts));
  running = &stages;
  FrameLoop loop(stages, loopOptions, stop, &recording->probe());
  const FrameLoopOutcome outcome = loop.run();
  reporter.progressOver();
  if (failure = outcome.failure; failure) {
    recording->keepLastFrames();
    nameNode(failure, player->scene());
    return findings.error({}, failure->message), std::nullopt;
  }
  recording->finishTrace(findings);
  if (findings.hasErrors()) return {};
  if (recording->lost() > 0)
    findings.warning({}, std::to_string(recording->lost()) + " spans were lost: they came faster than they "
                                                             "could be collected");
  ShowFigures figures =
      recording->figures(player->walls().names(), options.drawn ? stages.glDescription() : "");
  if (options.drawn) figures.warmUpMs = loop.times().warmUp;
  if (figures.frames == 0) return findings.error({}, tooShort("the show ended too early")), std::nullopt;
  if (html) {
    ReportHead head = reportHead(options, *player, stages.glDescription());
    if (figures.warmUpMs > 0)
      head.facts.emplace_back("warm-up", fmt::format("{:.3f} s before the first frame: shaders, uploads",
                                                     figures.warmUpMs / 1000));
    ReportData data = recording->report(std::move(head), figures);
    if (!stop) data.dynamics = dynamicsFigures(options, figures);
    html->write(reportPage(data));
    if (const auto why = html->commit()) return findings.add(*why), std::nullopt;
  }
  return figures;
}

}  // namespace stadion
