/// Costs by node, budgets, the trace, and the last frames.
///
/// They are recorded in every run, so that late frames have a cause and a program that crashes leaves what
/// its last frames were spent on. Only a run that is measured for a comparison goes without.

#include "show/recording/governor_options.h"
#include "show/recording/last_frames.h"
#include "show/recording/show_recording.h"
#include "show/session/session_part.h"

#include <chrono>

namespace stadion {
namespace {

constexpr std::uint64_t kCrowdedEvery = 32;

/// Late frames, in words: each one for the journal, one in ten seconds for the terminal.
std::function<void(const std::string&)> reportLate(RunJournal* journal, Reporter& reporter) {
  return
      [journal, &reporter, next = std::chrono::steady_clock::time_point{}](const std::string& text) mutable {
        if (journal) journal->late(text);
        constexpr std::chrono::seconds kApart{10};
        const auto now = std::chrono::steady_clock::now();
        if (now < next) return;
        next = now + kApart;
        reporter.hint("late: " + text);
      };
}

class RecordingPart final : public SessionPart {
public:
  explicit RecordingPart(SessionState& session) : session_(session) {}

  bool opened(Diagnostics& findings) override {
    recording_.reset();
    recording_ = ShowRecording::create(options(), findings);
    return recording_ != nullptr;
  }
  void beforeFrames(ShowParts& stages, FrameLoopOptions& loop) override {
    stages.probe = &recording_->probe();
    if (!session_.player->replaysLog()) loop.decider = recording_->governor();
  }
  void afterFrame(const TimeSignature&, const InputSample&, const Scene& scene) override {
    recording_->see(scene);
  }
  void ended(EndedLoop& show) override {
    if (show.outcome.failure) recording_->keepLastFrames();
  }
  void report(SessionReport& report) override {
    recording_->finish();
    addBudgets(report.summary);
    if (session_.settings.record.profile)
      report.figures = recording_->figures(session_.player->walls().names(), session_.stages->drawnBy());
    Diagnostics findings;
    recording_->finishTrace(findings);
    session_.reporter.report(findings);
    isIncomplete_ = findings.hasErrors();
    if (const BlackBox* box = recording_->blackBox()) report.lateFrames = lateFramesText(*box);
  }
  SessionEnd closed(SessionEnd end) override {
    return isIncomplete_ && end == SessionEnd::Played ? SessionEnd::Refused : end;
  }

private:
  RecordingOptions options() const {
    const SessionSettings& s = session_.settings;
    const Player& player = *session_.player;
    const std::vector<std::string> walls = player.walls().names();
    RecordingOptions o;
    if (session_.budget) o.also.push_back(session_.budget);
    if (session_.web) o.also.push_back(&session_.web->frameMeter());
    o.trace = s.record.trace;
    if (o.trace) {
      o.trace->show = s.show.script;
      o.trace->walls = walls;
    }
    o.profile = s.record.profile;
    o.log.whole = s.record.profile;
    o.log.shares = true;
    const bool governed = !s.play.everyFrameCounts(player) || s.record.profile || o.trace;
    const bool hasBudgets = governed && hasDrawnBudgets(session_.player->scene());
    o.log.samples = s.record.profile || hasBudgets;
    // Budgets must be kept soon. Without them nothing is urgent, and the show is not to be slower.
    if (!hasBudgets) o.log.crowdedEvery = kCrowdedEvery;
    if (governed) {
      o.govern = governorOf(s.play, player, walls, session_.reporter.sayFunction());
      o.govern->drawnElsewhere = session_.drawing && session_.drawing->setting().processes;
    }
    o.keep = lastFramesOf(s.play, s.record.blackBox, player, walls);
    o.keep->tell = reportLate(session_.journal, session_.reporter);
    if (session_.web) o.keep->late = session_.web->lateFunction(walls);
    return o;
  }

  void addBudgets(RunSummary& summary) const {
    const DegradationGovernor* governor = recording_->governor();
    if (!governor) return;
    if (const auto stress = governor->stress())
      summary.stress = StressSummary{stress->highest, stress->now, stress->changes};
    for (const BudgetReport& b : governor->reports())
      summary.budgets.push_back({b.name, b.file, b.line, b.budget, b.mean, b.worst, b.worstFrame,
                                 b.worstStage, b.overruns, b.changes, b.highest, b.now, b.levels,
                                 b.drawCounted, b.drawMeasured});
  }

  SessionState& session_;
  std::unique_ptr<ShowRecording> recording_;
  bool isIncomplete_ = false;  ///< the trace could not be written
};

}  // namespace

std::unique_ptr<SessionPart> makeRecordingPart(SessionState& session, Diagnostics&) {
  const RecordSettings& r = session.settings.record;
  const bool isMeasured = !r.spans.file.empty() || r.countWork || r.unrecorded;
  return isMeasured ? nullptr : std::make_unique<RecordingPart>(session);
}

}  // namespace stadion
