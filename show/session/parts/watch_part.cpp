/// Hashes, events, the recorded input and the poses of nodes.

#include "engine/base/atomic_file.h"
#include "show/session/session_part.h"

namespace stadion {
namespace {

class WatchPart final : public SessionPart {
public:
  explicit WatchPart(SessionState& session) : session_(session) {}

  bool opened(Diagnostics& findings) override {
    RecordSettings record = session_.settings.record;
    record.input = session_.console->fileOfGroup(record.input);
    if (!record.input.empty() && session_.cluster && session_.cluster->goesOn()) {
      session_.reporter.say(
          "--record-input: nothing is recorded: a record that begins in the middle of a show "
          "cannot be played");
      record.input.clear();
      session_.inputIsLost = true;
    }
    watch_ = RunWatch::create(record, session_.settings.play, *session_.player, findings);
    session_.watch = watch_.get();
    return watch_ != nullptr;
  }
  void afterFrame(const TimeSignature& now, const InputSample& input, const Scene& scene) override {
    watch_->see(now, input, scene);
  }
  void following(NextShow, Diagnostics& findings) override {
    if (const auto wrong = watch_->finish()) findings.add(*wrong);
    session_.watch = nullptr;
    watch_.reset();
  }
  void report(SessionReport& report) override {
    if (const auto wrong = watch_->finish())
      addFailure(report, Reason(*wrong, FailureKind::Refusal), session_.reporter);
    if (!session_.folder) return;
    for (const NodeTrace& trace : watch_->traces()) writeTable(trace, report);
  }

private:
  void writeTable(const NodeTrace& trace, SessionReport& report) {
    OutputFolder& folder = *session_.folder;
    const std::string name = "track-" + trace.fileName() + ".csv";
    auto wrong = folder.note(name);
    if (!wrong) wrong = writeFile(folder.pathOf(name), trace.table());
    if (!wrong)
      report.summary.files.push_back(folder.pathOf(name));
    else
      addFailure(report, Reason(*wrong, FailureKind::Refusal), session_.reporter);
  }

  SessionState& session_;
  std::unique_ptr<RunWatch> watch_;
};

}  // namespace

std::unique_ptr<SessionPart> makeWatchPart(SessionState& session, Diagnostics&) {
  return std::make_unique<WatchPart>(session);
}

}  // namespace stadion
