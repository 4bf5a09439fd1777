/// The operator console, trackers and sounds.

#include "show/session/session_part.h"

namespace stadion {
namespace {

class ConsolePart final : public SessionPart {
public:
  explicit ConsolePart(SessionState& session) : session_(session) {}

  bool opened(Diagnostics& findings) override {
    OperatorConsole& console = *session_.console;
    if (!std::exchange(begun_, true) && !console.begin(*session_.player, findings)) return false;
    console.beginGroup(*session_.player, *session_.watch);
    return true;
  }
  void beforeFrames(ShowParts& stages, FrameLoopOptions& loop) override {
    session_.console->addTo(stages, loop);
  }
  void shown() override {
    if (!session_.drawnInWindows) session_.console->pictureSeen();
  }
  void following(NextShow next, Diagnostics&) override {
    if (next == NextShow::OfGroup) session_.console->endGroup(*session_.watch);
  }
  void report(SessionReport& report) override {
    report.summary.groups = session_.console->groups();
    report.summary.uptimeSeconds = session_.console->uptime();
  }

private:
  SessionState& session_;
  bool begun_ = false;
};

}  // namespace

std::unique_ptr<SessionPart> makeConsolePart(SessionState& session, Diagnostics&) {
  return std::make_unique<ConsolePart>(session);
}

}  // namespace stadion
