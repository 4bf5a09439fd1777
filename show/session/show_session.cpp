#include "show/session/show_session.h"

#include "show/session/open_session.h"

namespace stadion {

ShowSession::ShowSession(SessionSettings settings, Reporter& reporter, const std::atomic<bool>& stop)
    : session_(std::make_unique<OpenSession>(std::move(settings), reporter, stop)) {}

ShowSession::~ShowSession() = default;

bool ShowSession::open(Diagnostics findings) {
  const bool isOpen = session_->open(findings);
  session_->reporter().report(findings);
  if (isOpen) return true;
  const SessionState& state = session_->state();
  end_ = session_->close(state.cluster && state.stop ? SessionEnd::Stopped : SessionEnd::NoShow);
  return false;
}

SessionEnd ShowSession::play() {
  using Then = OpenSession::Then;
  for (;;) {
    const Then then = session_->playOnce(report_);
    if (then == Then::Ends) {
      const SessionEnd end = report_->failure                    ? endOf(*report_->failure)
                             : !report_->summary.stopped.empty() ? SessionEnd::Stopped
                                                                 : SessionEnd::Played;
      return end_ = session_->close(end);
    }
    if (then == Then::NextGroup ? session_->nextGroup() : session_->rejoin()) continue;
    return end_ = session_->close(session_->state().stop ? SessionEnd::Stopped : SessionEnd::NoShow);
  }
}

const Player& ShowSession::player() const {
  return *session_->state().player;
}

bool ShowSession::follows() const {
  const ClusterSession* cluster = session_->state().cluster;
  return cluster && !cluster->leads();
}

}  // namespace stadion
