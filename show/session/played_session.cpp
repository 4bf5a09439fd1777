/// Plays the shows of a session, and reports on the last one.

#include "engine/base/atomic_file.h"
#include "pipeline/platform/topology.h"
#include "show/player/write_watching.h"
#include "show/session/open_session.h"

#include <algorithm>
#include <chrono>

namespace stadion {
namespace {

/// How long after the stop signal frames may still be drawn.
constexpr std::chrono::seconds kDrawAfterStop{5};

}  // namespace

/// The parts of the stages, without what the session's parts add.
ShowParts OpenSession::stageParts() {
  const SessionSettings& s = state_.settings;
  ShowParts parts =
      player_->parts(s.draw.layout, state_.cluster ? state_.cluster->inputOf(*player_) : nullptr);
  if (drawing_)
    parts.wallProcesses =
        s.wallProcesses(*player_, drawing_->setting(), renderer_->kind(), reporter_.sayFunction());
  renderer_->drawFor(parts);
  if (drawing_ && drawing_->setting().pinned)
    parts.processors = Topology::ofThisMachine().parts(parts.walls.size());
  parts.head = s.draw.headFor(parts.walls);
  if (console_->kept()) parts.contexts = &console_->kept()->contexts;
  parts.giveUp = [] { return sinceStopSignal() > kDrawAfterStop; };
  parts.observer = [this](const TimeSignature& now, const InputSample& input, const Scene& scene) {
    for (const auto& part : parts_) part->afterFrame(now, input, scene);
    reporter_.progress(now.frame + 1, player_->frames());
  };
  parts.shown = [this] {
    for (const auto& part : parts_) part->shown();
  };
  return parts;
}

OpenSession::Then OpenSession::playOnce(std::optional<SessionReport>& report) {
  FrameLoopOptions options = state_.settings.play.loopOptions(*player_);
  ShowParts parts = stageParts();
  for (const auto& part : parts_) part->beforeFrames(parts, options);
  state_.played = true;
  if (options.after) state_.watch->goOnAfter(*options.after, player_->scene());
  FrameProbe* const probe = parts.probe;
  const auto watch = watchWrites(state_.settings.play.guard, parts, options);
  ShowStages stages(std::move(parts));
  state_.stages = &stages;
  FrameLoop loop(stages, options, state_.stop, probe);
  state_.loop = &loop;

  const auto start = std::chrono::steady_clock::now();
  FrameLoopOutcome outcome = state_.runLoop(loop);
  nameNode(outcome.failure, player_->scene());
  const double elapsed = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  reporter_.progressOver();
  EndedLoop show{outcome, state_.stop || !outcome.nextGroup};
  for (auto part = parts_.rbegin(); part != parts_.rend(); ++part) (*part)->ended(show);
  const bool isLast = outcome.failure || (show.ends && !show.rejoin);
  if (isLast) fillReport(report.emplace(), outcome, elapsed);
  state_.stages = nullptr;
  state_.loop = nullptr;
  return isLast ? Then::Ends : show.rejoin ? Then::Rejoin : Then::NextGroup;
}

void OpenSession::fillReport(SessionReport& report, const FrameLoopOutcome& outcome, double elapsed) {
  const SessionSettings& s = state_.settings;
  RunSummary& summary = report.summary;
  addFailure(report, outcome.failure, reporter_);
  summary.show = s.show.script;
  summary.walls = s.show.walls;
  summary.mode = nameOf(s.show.mode);
  summary.stereo = stereoLayoutName(s.draw.layout);
  summary.width = s.show.width;
  summary.height = s.show.height;
  summary.rate = player_->rate();
  summary.frames = outcome.framesShown;
  summary.framesDrawn = outcome.framesDrawn;
  // If the newest frame counts, the frames that App had no time for are among those not shown.
  const bool byTicks = s.play.loopOptions(*player_).pace != Pace::Free;
  summary.lateFrames = byTicks ? std::max(outcome.missedTicks, outcome.ticksWithoutFrame) : 0;
  summary.mostTicksWithoutFrame = outcome.mostTicksWithoutFrame;
  if (const LatchCounts* c = state_.stages->latched())
    summary.lateLatch = LateLatchSummary{c->latched, c->beyond, c->farthest, c->widest};
  if (s.draw.ahead) summary.aimedAt = 1e3 * toSeconds(state_.stages->aimedAt());
  summary.elapsedSeconds = elapsed;
  state_.watch->addTo(summary, outcome.framesSimulated);
  addTimes(summary);
  addDrawing(summary);
  if (outcome.stopped) summary.stopped = stopSignalName();
  for (auto part = parts_.rbegin(); part != parts_.rend(); ++part) (*part)->report(report);
  state_.reported = true;
  if (report.failure) summary.failure = report.failure->message;
  if (state_.folder) writeSummary(report);
}

void OpenSession::addDrawing(RunSummary& summary) const {
  const std::string drawn = state_.stages->drawnBy();
  summary.remarks.push_back(drawn.empty() ? "nothing was drawn" : "drawn by " + drawn);
  if (!drawing_) return;
  const DrawSetting& how = drawing_->setting();
  DrawingSummary& to = summary.drawing;
  to.renderer = renderer_->drawsWithGl() ? "gl" : "cpu";
  to.chosen = renderer_->why();
  to.drawnBy = how.processes ? "process" : "thread";
  to.threads = how.rasteriserThreads;
  to.pinned = how.pinned;
  to.why = drawing_->why();
  to.text = drawing_->text(player_->walls().walls.size());
}

void OpenSession::addTimes(RunSummary& s) const {
  const FrameTimes& t = state_.loop->times();
  const ShowStages& stages = *state_.stages;
  s.frameMs = sampleStatisticsOf(t.period.values());
  if (stages.drawnBy() != "") s.warmUpMs = t.warmUp;
  const std::string clock = "steady clock around the stage",
                    finish = std::string("steady clock around draw + finish + read back") +
                             (state_.settings.play.drawBeginsEarly ? ", with its waits for Cull" : "");
  s.stages.push_back({"app", "", sampleStatisticsOf(t.app.values()), clock});
  if (state_.settings.play.guard) s.counters.merge(costOfWatch(s.stages.back().ms));
  for (std::size_t w = 0; w < t.draw.size(); ++w) {
    const std::string& name = player_->walls().walls[w].wall.name;
    s.stages.push_back({"cull", name, sampleStatisticsOf(t.cull[w].values()), clock});
    s.stages.push_back({"draw", name, sampleStatisticsOf(t.draw[w].values()), finish});
    s.latency.push_back({name, sampleStatisticsOf(t.latency[w].values())});
    if (const WallLateness& late = stages.late(w); late.frames > 0)
      s.lateWalls.push_back({name, late.frames, late.inARow});
    const std::vector<Picture>& eyes = stages.lastPictures()[w].eyes;
    const ViewTotals& drawn = stages.drawn(w);
    for (std::size_t e = 0; e < drawn.size(); ++e)
      if (const DrawTotals& d = drawn[e]; d.frames > 0)
        s.drawn.push_back({name, pictureName(e), d.frames, d.calls, d.instances, d.triangles});
    if (stages.lastPictures()[w].frame != s.lastFrame) continue;
    for (std::size_t e = 0; e < eyes.size(); ++e)
      s.imageHashes.push_back({name, pictureName(e), imageHash(eyes[e])});
  }
}

void OpenSession::writeSummary(SessionReport& report) {
  OutputFolder& folder = *state_.folder;
  auto wrong = folder.note("summary.json");
  if (!wrong) wrong = writeFile(folder.pathOf("summary.json"), toJson(report.summary) + "\n");
  if (!wrong)
    report.summary.files.push_back(folder.pathOf("summary.json"));
  else
    addFailure(report, Reason(*wrong, FailureKind::Refusal), reporter_);
}

}  // namespace stadion
