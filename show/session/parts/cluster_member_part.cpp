/// The other machines of a cluster.

#include "show/session/session_part.h"

namespace stadion {
namespace {

class ClusterMemberPart final : public SessionPart {
public:
  ClusterMemberPart(SessionState& session, std::unique_ptr<ClusterSession> cluster)
      : session_(session), cluster_(std::move(cluster)) {
    session.cluster = cluster_.get();
  }

  bool opened(Diagnostics& findings) override {
    return cluster_->begin(*session_.player, session_.console->queue(), session_.takeKeys, findings);
  }
  void beforeFrames(ShowParts&, FrameLoopOptions& loop) override { cluster_->addTo(loop, *session_.console); }
  void afterFrame(const TimeSignature& now, const InputSample&, const Scene&) override {
    cluster_->simulated(now);
  }
  void ended(EndedLoop& show) override {
    cluster_->finish(show.ends && !show.outcome.failure);
    // Asked after that: meanwhile the show may have ended for all.
    show.rejoin = cluster_->mustRejoin() && !session_.stop;
  }
  void report(SessionReport& report) override { report.summary.cluster = cluster_->summary(); }
  SessionEnd closed(SessionEnd end) override {
    if (session_.played && !session_.reported && cluster_->leads()) cluster_->finish(true);
    if (end == SessionEnd::Played)
      return cluster_->summary().stopped ? SessionEnd::Failed : isAllThere() ? end : SessionEnd::Refused;
    if (end != SessionEnd::NoShow) return end;
    if (cluster_->isOver()) return isAllThere() ? SessionEnd::Played : SessionEnd::Refused;
    return cluster_->hasOtherFiles() ? SessionEnd::OtherFiles : end;
  }

private:
  /// Of a show that was played well, or is over: whether all results that were asked for are there.
  bool isAllThere() const {
    if (session_.inputIsLost || cluster_->hasDouble()) return false;
    const bool keepsPictures =
        !session_.settings.draw.renderer.drawsNothing() && session_.settings.record.keepsPictures();
    if (!keepsPictures || !cluster_->missedTheEnd()) return true;
    session_.reporter.say(
        "--out: the show ended before this machine had caught up with it: its last pictures are "
        "missing");
    return false;
  }

  SessionState& session_;
  std::unique_ptr<ClusterSession> cluster_;
};

}  // namespace

std::unique_ptr<SessionPart> makeClusterMemberPart(SessionState& session, Diagnostics& findings) {
  SessionSettings& s = session.settings;
  auto cluster =
      ClusterSession::create(s.cluster, s.show, s.draw.layout, session.reporter.sayFunction(), findings);
  if (!cluster) return nullptr;
  s.console.elsewhere = !cluster->leads();
  if (!cluster->hasWalls()) {
    s.draw.renderer.choice = RendererChoice::None;
    s.record.sheets = s.record.video = false;
  }
  return std::make_unique<ClusterMemberPart>(session, std::move(cluster));
}

}  // namespace stadion
