/// Counts of the work of a show: pixels, contacts and so on.

#include "profiling/regression/spans/work_counts.h"
#include "show/session/session_part.h"

namespace stadion {
namespace {

class WorkCountPart final : public SessionPart {
public:
  explicit WorkCountPart(SessionState& session) : session_(session) {}

  void beforeFrames(ShowParts& stages, FrameLoopOptions&) override { stages.probe = &work_; }
  void report(SessionReport& report) override {
    const std::map<std::string, double> totals = work_.totals(session_.player->walls().names());
    report.summary.counters.insert(totals.begin(), totals.end());
  }

private:
  SessionState& session_;
  regression::WorkCounts work_;
};

}  // namespace

std::unique_ptr<SessionPart> makeWorkCountPart(SessionState& session, Diagnostics&) {
  return session.settings.record.countWork ? std::make_unique<WorkCountPart>(session) : nullptr;
}

}  // namespace stadion
