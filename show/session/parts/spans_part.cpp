/// Costs by frame, stage and node, for comparisons.

#include "show/recording/span_recording.h"
#include "show/session/session_part.h"

namespace stadion {
namespace {

class SpansPart final : public SessionPart {
public:
  explicit SpansPart(SessionState& session) : session_(session) {}

  bool opened(Diagnostics& findings) override {
    spans_ = SpanRecording::create(session_.settings.record.spans, *session_.player, findings);
    return !findings.hasErrors();
  }
  void beforeFrames(ShowParts& stages, FrameLoopOptions&) override {
    if (spans_) stages.probe = spans_->probe();
  }
  void report(SessionReport&) override {
    if (spans_) wrong_ = spans_->finish();
  }
  SessionEnd closed(SessionEnd end) override {
    if (!wrong_) return end;
    session_.reporter.fault("--spans: " + wrong_->message);
    return SessionEnd::Refused;
  }

private:
  SessionState& session_;
  std::unique_ptr<SpanRecording> spans_;
  std::optional<Diagnostic> wrong_;
};

}  // namespace

std::unique_ptr<SessionPart> makeSpansPart(SessionState& session, Diagnostics&) {
  const SpanOptions& asked = session.settings.record.spans;
  return asked.file.empty() && asked.planted.empty() ? nullptr : std::make_unique<SpansPart>(session);
}

}  // namespace stadion
