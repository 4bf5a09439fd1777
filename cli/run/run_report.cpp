#include "cli/run/run_report.h"

#include "cli/exit_code.h"
#include "engine/base/atomic_file.h"
#include "show/base/stop_signal.h"
#include "show/session/last_frames.h"
#include "show/session/span_recording.h"

#include <algorithm>
#include <cstdio>
#include <fmt/format.h>

namespace stadion {
namespace {

void addTimes(const FinishedRun& run, RunSummary& s) {
  const FrameTimes& t = run.loop.times();
  s.frameMs = distributionOf(t.period.values());
  if (run.stages.glDescription() != "") s.warmUpMs = t.warmUp;
  const std::string clock = "steady clock around the stage",
                    finish = std::string("steady clock around draw + finish + read back") +
                             (run.options.cullDraw == "overlap" ? ", with its waits for Cull" : "");
  s.stages.push_back({"app", "", distributionOf(t.app.values()), clock});
  for (std::size_t w = 0; w < t.draw.size(); ++w) {
    const std::string& name = run.player.walls().walls[w].wall.name;
    s.stages.push_back({"cull", name, distributionOf(t.cull[w].values()), clock});
    s.stages.push_back({"draw", name, distributionOf(t.draw[w].values()), finish});
    s.latency.push_back({name, distributionOf(t.latency[w].values())});
    if (const WallLateness& late = run.stages.late(w); late.frames > 0)
      s.lateWalls.push_back({name, late.frames, late.inARow});
    const std::vector<Picture>& eyes = run.stages.lastPictures()[w].eyes;
    const std::array<DrawTotals, 2>& drawn = run.stages.drawn(w);
    for (std::size_t e = 0; e < drawn.size(); ++e)
      if (const DrawTotals& d = drawn[e]; d.frames > 0)
        s.drawn.push_back({name, eyeName(kEyes[e]), d.frames, d.calls, d.instances, d.triangles});
    if (run.stages.lastPictures()[w].frame != s.lastFrame) continue;
    for (std::size_t e = 0; e < eyes.size(); ++e)
      s.imageHashes.push_back({name, eyeName(kEyes[e]), imageHash(eyes[e])});
  }
}

void addBudgets(ShowRecording* recording, RunSummary& s) {
  if (!recording) return;
  recording->finish();
  const LoadGovernor* governor = recording->governor();
  if (!governor) return;
  if (const auto stress = governor->stress())
    s.stress = StressFelt{stress->highest, stress->now, stress->changes};
  for (const BudgetReport& b : governor->reports())
    s.budgets.push_back({b.name, b.file, b.line, b.budget, b.mean, b.worst, b.worstFrame, b.worstStage,
                         b.overruns, b.changes, b.highest, b.now, b.levels, b.drawCounted, b.drawMeasured});
}

RunSummary summarise(const FinishedRun& run) {
  const RunOptions& o = run.options;
  RunSummary s;
  s.show = o.show.script, s.walls = o.show.walls, s.mode = o.show.mode, s.stereo = o.stereo;
  s.width = o.show.width, s.height = o.show.height, s.rate = run.player.rate();
  s.frames = run.outcome.framesShown, s.framesDrawn = run.outcome.framesDrawn;
  // Of a show of which the newest frame counts, those that App had no time for are among those not shown.
  const bool byTicks = o.loopOptions(run.player).pace != Pace::Free;
  s.lateFrames = byTicks ? std::max(run.outcome.missedTicks, run.outcome.ticksPassedOver) : 0;
  s.mostPassedOver = run.outcome.mostPassedOver;
  if (const LatchCounts* c = run.stages.latched())
    s.latched = LateLatched{c->latched, c->beyond, c->farthest, c->widest};
  if (o.ahead) s.aimedAt = 1e3 * toSeconds(run.stages.aimedAt());
  s.elapsedSeconds = run.elapsed;
  s.groups = run.groups, s.uptimeSeconds = run.uptime;
  run.watch.addTo(s, run.outcome.framesSimulated);
  s.counters.insert(run.work.begin(), run.work.end());
  addTimes(run, s);
  if (run.drawing) {
    const DrawSetting& how = run.drawing->setting();
    s.howDrawn = {how.processes ? "process" : "thread", how.rasteriserThreads, how.pinned, run.drawing->why(),
                  textOf(how, run.player.walls().walls.size())};
  }
  const std::string drawn = run.stages.glDescription();
  s.remarks.push_back(drawn.empty() ? "nothing was drawn" : "drawn by " + drawn);
  if (!run.remark.empty()) s.remarks.push_back(run.remark);
  addBudgets(run.recording, s);
  if (run.cluster) s.cluster = run.cluster->summary();
  if (run.outcome.stopped) s.stopped = stopSignalName();
  return s;
}

/// The first failure is told and decides the exit code; what follows from it is not told again.
class Verdict {
public:
  void add(const Failure& why) {
    if (!why || failure_) return;
    failure_ = why;
    std::fprintf(stderr, "stadion: %s\n", why->message.c_str());
  }
  void add(const std::optional<Diagnostic>& why) {
    if (why) add(Failure(Reason(*why, FailureKind::Refusal)));
  }
  const Failure& failure() const { return failure_; }
  int code(bool stopped) const {
    return failure_ ? exitCodeOf(*failure_) : stopped ? kStopped + stopSignal() : kOk;
  }

private:
  Failure failure_;
};

void writeTable(const NodeTrace& trace, OutputFolder& folder, RunSummary& summary, Verdict& verdict) {
  const std::string name = "trace-" + trace.fileName() + ".csv";
  auto wrong = folder.note(name);
  if (!wrong) wrong = writeFile(folder.pathOf(name), trace.table());
  if (!wrong) summary.files.push_back(folder.pathOf(name));
  verdict.add(wrong);
}

void writeSummary(OutputFolder& folder, RunSummary& summary, Verdict& verdict) {
  auto wrong = folder.note("summary.json");
  if (!wrong) wrong = writeFile(folder.pathOf("summary.json"), toJson(summary) + "\n");
  if (!wrong) summary.files.push_back(folder.pathOf("summary.json"));
  verdict.add(wrong);
}

void print(const RunOptions& o, const RunSummary& summary) {
  if (o.json) {
    std::printf("%s\n", toJson(summary).c_str());
    return;
  }
  std::printf("%s%s", toText(summary).c_str(), happeningsText(summary).c_str());
  if (o.out.empty() && !o.display)
    std::printf("\nTo see it:  ./stadion view %s, or ./stadion run %s --out pictures\n",
                o.show.script.c_str(), o.show.script.c_str());
}

}  // namespace

int report(const FinishedRun& run, RunOutput* output, OutputFolder* folder) {
  Verdict verdict;
  verdict.add(run.outcome.failure);
  RunSummary summary = summarise(run);
  if (output) {
    output->finish(run.stages.lastPictures());
    summary.files = output->files();
    summary.remarks.insert(summary.remarks.end(), output->remarks().begin(), output->remarks().end());
    verdict.add(output->failure());
  }
  verdict.add(run.watch.finish());
  if (folder)
    for (const NodeTrace& t : run.watch.traces()) writeTable(t, *folder, summary, verdict);
  if (verdict.failure()) summary.failure = verdict.failure()->message;
  if (folder) writeSummary(*folder, summary, verdict);
  print(run.options, summary);
  return verdict.code(run.outcome.stopped);
}

bool tellRecording(const RunOptions& o, ShowRecording& recording, const Player& player,
                   const std::string& gl) {
  constexpr std::size_t kNodes = 10;
  if (o.profile)
    std::fprintf(stderr, "\n%s", toText(recording.figures(player.walls().names(), gl), kNodes).c_str());
  recording.finish();
  Diagnostics findings;
  recording.finishTrace(findings);
  tell(findings);
  if (const BlackBox* box = recording.blackBox()) std::fputs(lateFramesText(*box).c_str(), stderr);
  return !findings.hasErrors();
}

}  // namespace stadion
