/// The sound of a show as a file of the output folder, if the hall has loudspeakers.

#include "pipeline/sound/sound_recording.h"
#include "show/session/session_part.h"

#include <fmt/format.h>

namespace stadion {
namespace {

constexpr const char* kSoundFile = "sound.wav";

class SoundRecordingPart final : public SessionPart {
public:
  explicit SoundRecordingPart(SessionState& session) : session_(session) {}

  void beforeFrames(ShowParts& stages, FrameLoopOptions&) override {
    const LoudspeakerSet& hall = session_.player->walls().loudspeakers;
    if (hall.empty()) return;
    if (!recording_) {
      roots_ = AssetRoots::ofScript(session_.settings.show.script);
      for (const std::string& root : session_.settings.show.assetRoots) roots_.add(root);
      recording_.emplace(hall, roots_, [this] { return begin(); });
    }
    recording_->passTo(stages.sounds);
    stages.sounds = &*recording_;
  }
  void report(SessionReport& report) override {
    if (!recording_ || recording_->file().empty()) return;
    auto wrong = noted_ ? noted_ : recording_->finish();
    if (wrong) return addFailure(report, Reason(*wrong, FailureKind::Refusal), session_.reporter);
    report.summary.files.push_back(recording_->file());
    if (recording_->clipped() > 0)
      report.summary.remarks.push_back(
          fmt::format("{} samples of {} were clipped: lower the volume, or the gain of sounds",
                      recording_->clipped(), kSoundFile));
  }
  SessionEnd closed(SessionEnd end) override {
    const bool isOpen = recording_ && !session_.reported && !noted_;
    const auto wrong = isOpen ? recording_->finish() : std::nullopt;
    if (!wrong) return end;
    session_.reporter.fault(wrong->message);
    return SessionEnd::Refused;
  }

private:
  /// Its name is noted before it is written.
  std::string begin() {
    noted_ = session_.folder->note(kSoundFile);
    return session_.folder->pathOf(kSoundFile);
  }

  SessionState& session_;
  AssetRoots roots_;
  std::optional<SoundRecording> recording_;
  std::optional<Diagnostic> noted_;
};

}  // namespace

std::unique_ptr<SessionPart> makeSoundRecordingPart(SessionState& session, Diagnostics&) {
  const SessionSettings& s = session.settings;
  return s.record.out.empty() || s.console.noSound ? nullptr : std::make_unique<SoundRecordingPart>(session);
}

}  // namespace stadion
