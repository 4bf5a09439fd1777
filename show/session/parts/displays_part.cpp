/// Windows on the real outputs of the walls.

#include "show/display/display_run.h"
#include "show/session/session_part.h"

namespace stadion {
namespace {

class DisplaysPart final : public SessionPart {
public:
  explicit DisplaysPart(SessionState& session) : session_(session) {
    session.drawnInWindows = true;
    session.budget = &budget_;
  }

  bool opened(Diagnostics& findings) override {
    if (displays_) return true;
    const SessionSettings& s = session_.settings;
    displays_ =
        DisplayRun::open(s.show, session_.renderer->drawsWithGl(), s.draw.layout, session_.player->walls(),
                         budget_, s.play.hud, s.play.swapSync, session_.reporter, findings);
    if (!displays_) return false;
    session_.takeKeys = [this] { return displays_->takeKeys(*session_.console); };
    session_.runLoop = [this](FrameLoop& loop) { return displays_->play(loop, *session_.console); };
    return true;
  }
  void beforeFrames(ShowParts& stages, FrameLoopOptions&) override {
    stages.sink = &displays_->sink();
    displays_->fitPictures(stages.walls);
  }
  SessionEnd closed(SessionEnd end) override {
    const auto lost = displays_ && !session_.reported ? displays_->lost() : std::nullopt;
    if (!lost) return end;
    session_.reporter.fault(*lost);
    return SessionEnd::Failed;
  }

private:
  SessionState& session_;
  LiveBudget budget_;
  std::unique_ptr<DisplayRun> displays_;
};

}  // namespace

std::unique_ptr<SessionPart> makeDisplaysPart(SessionState& session, Diagnostics&) {
  return session.settings.play.display ? std::make_unique<DisplaysPart>(session) : nullptr;
}

}  // namespace stadion
