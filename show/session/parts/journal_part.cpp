/// The journal of a run.

#include "show/session/session_part.h"

namespace stadion {
namespace {

class JournalPart final : public SessionPart {
public:
  explicit JournalPart(SessionState& session) : session_(session), journal_(*session.journal) {}

  void beforeFrames(ShowParts&, FrameLoopOptions&) override {
    if (!session_.played) journal_.began(session_.settings.show, *session_.player);
  }
  void afterFrame(const TimeSignature& now, const InputSample& input, const Scene& scene) override {
    journal_.see(now, input, scene);
  }
  void shown() override {
    if (journal_.shown()) journal_.firstPicture(session_.stages->drawnBy());
  }
  void following(NextShow next, Diagnostics&) override {
    if (next == NextShow::OfGroup) journal_.beginGroup();
  }
  SessionEnd closed(SessionEnd end) override {
    const int status = statusOf(end);
    return journal_.ended(status) == status ? end : SessionEnd::Refused;
  }

private:
  SessionState& session_;
  RunJournal& journal_;
};

}  // namespace

std::unique_ptr<SessionPart> makeJournalPart(SessionState& session, Diagnostics&) {
  return session.journal ? std::make_unique<JournalPart>(session) : nullptr;
}

}  // namespace stadion
