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

/// Limits a run that nothing else ends. Returns false if it would be too short to be recorded.
bool limitFrames(FrameLoopOptions& loop, Diagnostics& findings) {
  if (loop.frames == 0 && loop.end == 0) loop.frames = kProfiledWithoutInput;
  if (loop.frames == 0 || loop.frames > kUnrecorded) return true;
  findings.error({}, tooShort("too few frames: " + std::to_string(loop.frames)));
  return false;
}

/// One run of a show that is recorded. Borrows all that it is made of.
class RecordedRun {
public:
  RecordedRun(const ProfileRunOptions& options, ShowRenderer& renderer, Player& player,
              ShowRecording& recording, const FrameLoopOptions& loop, const std::atomic<bool>& stop,
              Reporter& reporter)
      : player_(player), recording_(recording), reporter_(reporter), loopOptions_(loop),
        stages_(wire(options, renderer)), loop_(stages_, loopOptions_, stop, &recording.probe()) {}
  RecordedRun(const RecordedRun&) = delete;
  RecordedRun& operator=(const RecordedRun&) = delete;

  FrameLoopOutcome play() {
    FrameLoopOutcome outcome = loop_.run();
    reporter_.progressOver();
    return outcome;
  }
  std::string drawnBy() const { return stages_.drawnBy(); }
  /// What the run has cost, once it has been played.
  ShowFigures figures(bool isDrawn) {
    ShowFigures figures = recording_.figures(player_.walls().names(), drawnBy());
    if (isDrawn) figures.warmUpMs = loop_.times().warmUp;
    if (watch_) figures.counters = costOfWatch(sampleStatisticsOf(loop_.times().app.values()));
    return figures;
  }

private:
  ShowParts wire(const ProfileRunOptions& options, ShowRenderer& renderer) {
    ShowParts parts = player_.parts(options.layout);
    renderer.drawFor(parts);
    parts.probe = &recording_.probe();
    parts.observer = [this](const TimeSignature& now, const InputSample&, const Scene& scene) {
      recording_.see(scene);
      reporter_.progress(now.frame + 1, loopOptions_.frames);
    };
    watch_ = watchWrites(options.guard, parts, loopOptions_);
    return parts;
  }

  Player& player_;
  ShowRecording& recording_;
  Reporter& reporter_;
  FrameLoopOptions loopOptions_;
  std::unique_ptr<WriteWatch> watch_;  ///< goes after the stages
  ShowStages stages_;
  FrameLoop loop_;
};

/// Returns false, and says why in `findings`, if the run has failed or lost its trace.
bool isWhole(const FrameLoopOutcome& outcome, Player& player, ShowRecording& recording, Diagnostics& findings,
             Failure& failure) {
  if (failure = outcome.failure; failure) {
    recording.keepLastFrames();
    nameNode(failure, player.scene());
    findings.error({}, failure->message);
    return false;
  }
  recording.finishTrace(findings);
  if (findings.hasErrors()) return false;
  if (recording.lost() > 0)
    findings.warning({}, std::to_string(recording.lost()) + " spans were lost: they came faster than they "
                                                            "could be collected");
  return true;
}

/// Returns false, and says why in `findings`, if a file cannot be written.
bool writeReports(const ProfileRunOptions& options, const ShowFigures& figures, ReportHead head,
                  ShowRecording& recording, const std::atomic<bool>& stop, OutputFiles& files,
                  Diagnostics& findings) {
  if (figures.warmUpMs > 0)
    head.facts.emplace_back(
        "warm-up", fmt::format("{:.3f} s before the first frame: shaders, uploads", figures.warmUpMs / 1000));
  for (const auto& [name, value] : figures.counters)
    head.facts.emplace_back(name, fmt::format("{:g}", value));
  ReportData data = recording.report(std::move(head), figures);
  if (!stop) data.dynamics = dynamicsFigures(options, figures, files);
  files.write("profile.html", reportPage(data));
  files.write("profile.json", toJson(figures) + "\n");
  files.write("profile.csv", toCsv(figures));
  return files.commit(findings);
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
  FrameLoopOptions loop = player->loopOptions();
  if (!limitFrames(loop, findings)) return {};
  // Files are opened before anything is played.
  files.open(findings);
  const auto recording = record(options, files.areWanted(), *player, findings);
  if (!recording || findings.hasErrors()) return {};

  RecordedRun run(options, *renderer.value(), *player, *recording, loop, stop, reporter);
  if (!isWhole(run.play(), *player, *recording, findings, failure)) return {};
  ShowFigures figures = run.figures(!options.renderer.drawsNothing());
  if (figures.frames == 0) {
    findings.error({}, tooShort("the show ended too early"));
    return std::nullopt;
  }
  if (!files.areWanted()) return figures;
  ReportHead head = reportHead(options, *player, run.drawnBy());
  if (!writeReports(options, figures, std::move(head), *recording, stop, files, findings)) return {};
  return figures;
}

}  // namespace stadion
