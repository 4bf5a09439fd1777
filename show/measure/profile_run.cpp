#include "show/measure/profile_run.h"

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

std::unique_ptr<ShowRecording> record(const ProfileRunOptions& options, bool reports, const Player& player,
                                      Diagnostics& findings) {
  RecordingOptions recorded;
  const std::vector<std::string> walls = player.walls().names();
  recorded.trace = options.trace;
  if (recorded.trace) {
    recorded.trace->show = options.show.script;
    recorded.trace->walls = walls;
  }
  recorded.keep = unaskedLastFrames(walls);
  if (reports) recorded.report = RecordingOptions::Report{player.rate(), walls};
  return findings.hasErrors() ? nullptr : ShowRecording::create(std::move(recorded), findings);
}

}  // namespace

OutputFiles profileFiles(const std::string& folder, bool fidelityAsked) {
  std::vector<std::string> names{"profile.html", "profile.json", "profile.csv"};
  if (fidelityAsked) names.emplace_back("fidelity.json");
  return {folder, std::move(names)};
}

std::optional<ShowFigures> profileShow(const ProfileRunOptions& options, OutputFiles& files,
                                       Reporter& reporter, Diagnostics& findings, Failure& failure) {
  const std::atomic<bool>& stop = catchStopSignals();
  const auto renderer = ShowRenderer::open(options.renderer);
  if (!renderer) {
    findings.add(renderer.error());
    return std::nullopt;
  }
  const auto player = Player::create(options.show, findings, reporter.reportFunction(), &stop);
  if (!player) return {};
  FrameLoopOptions loopOptions = player->loopOptions();
  if (loopOptions.frames == 0 && loopOptions.end == 0) loopOptions.frames = kProfiledWithoutInput;

  if (loopOptions.frames > 0 && loopOptions.frames <= kUnrecorded) {
    findings.error({}, tooShort("too few frames: " + std::to_string(loopOptions.frames)));
    return std::nullopt;
  }

  // Files are opened before anything is played.
  files.open(findings);
  const auto recording = record(options, files.areWanted(), *player, findings);
  if (!recording || findings.hasErrors()) return {};
  const ShowStages* running = nullptr;
  ShowParts parts = player->parts(options.layout);
  renderer.value()->drawFor(parts);
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
    findings.error({}, failure->message);
    return std::nullopt;
  }
  recording->finishTrace(findings);
  if (findings.hasErrors()) return {};
  if (recording->lost() > 0)
    findings.warning({}, std::to_string(recording->lost()) + " spans were lost: they came faster than they "
                                                             "could be collected");
  ShowFigures figures = recording->figures(player->walls().names(), stages.drawnBy());
  if (!options.renderer.drawsNothing()) figures.warmUpMs = loop.times().warmUp;
  if (watch) figures.counters = costOfWatch(sampleStatisticsOf(loop.times().app.values()));
  if (figures.frames == 0) {
    findings.error({}, tooShort("the show ended too early"));
    return std::nullopt;
  }
  if (files.areWanted()) {
    ReportHead head = reportHead(options, *player, stages.drawnBy());
    if (figures.warmUpMs > 0)
      head.facts.emplace_back("warm-up", fmt::format("{:.3f} s before the first frame: shaders, uploads",
                                                     figures.warmUpMs / 1000));
    for (const auto& [name, value] : figures.counters)
      head.facts.emplace_back(name, fmt::format("{:g}", value));
    ReportData data = recording->report(std::move(head), figures);
    if (!stop) data.dynamics = dynamicsFigures(options, figures, files);
    files.write("profile.html", reportPage(data));
    files.write("profile.json", toJson(figures) + "\n");
    files.write("profile.csv", toCsv(figures));
    if (!files.commit(findings)) return {};
  }
  return figures;
}

}  // namespace stadion
