/// The supervisor of this process, and the snapshots for the process that would replace it.

#include "show/session/session_part.h"

namespace stadion {
namespace {

class SupervisionPart final : public SessionPart {
public:
  SupervisionPart(SessionState& session, std::unique_ptr<SupervisedPlayer> supervised)
      : session_(session), supervised_(std::move(supervised)) {
    session.supervised = supervised_.get();
  }

  bool opened(Diagnostics&) override {
    session_.console->seen = [this] { supervised_->shown(); };
    return true;
  }
  void beforeFrames(ShowParts&, FrameLoopOptions& loop) override {
    supervised_->goOn(loop, *session_.console, *session_.watch);
    session_.player->tellWaiting([this](bool waits) {  // a show that waits for files does not hang
      supervised_->enter(waits ? SharedProgress::Phase::Opening : SharedProgress::Phase::Playing);
    });
    supervised_->enter(SharedProgress::Phase::Playing);
  }
  void afterFrame(const TimeSignature& now, const InputSample&, const Scene&) override {
    supervised_->simulated(now, session_.player->scene(), *session_.watch, session_.loop->catchesUp());
  }
  void ended(EndedLoop&) override { supervised_->enter(SharedProgress::Phase::Ending); }
  void following(NextShow next, Diagnostics&) override {
    if (next == NextShow::Rejoined) return;
    supervised_->enter(SharedProgress::Phase::Opening);
    supervised_->beginGroup();
  }
  void report(SessionReport& report) override {
    const std::string remark = supervised_->remark();
    if (!remark.empty()) report.summary.remarks.push_back(remark);
  }

private:
  SessionState& session_;
  std::unique_ptr<SupervisedPlayer> supervised_;
};

}  // namespace

std::unique_ptr<SessionPart> makeSupervisionPart(SessionState& session, Diagnostics& findings) {
  const SessionSettings& s = session.settings;
  auto supervised = SupervisedPlayer::create(s.supervision, s.cluster.file.empty(),
                                             session.reporter.sayFunction(), findings);
  return supervised ? std::make_unique<SupervisionPart>(session, std::move(supervised)) : nullptr;
}

}  // namespace stadion
