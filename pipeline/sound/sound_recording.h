#pragma once
/// Records the sound of a show for the loudspeakers of a hall, by show time: a WAV file with a channel for each.
///
/// A sound begins at its exact sample, and gains run linearly from frame to frame. So the samples follow from the
/// frames' times and sounds alone: they are the same in every mode, at every speed and on every machine. The file
/// begins with the show and is made when the first sound plays. A show without sounds leaves none.
///
/// Ownership  borrows the roots and the next sink, which must outlive it.
/// Threads    App.
/// Errors     finish() reports what is wrong with the file.

#include "pipeline/sound/sample_store.h"
#include "pipeline/sound/sound_sink.h"
#include "pipeline/sound/speaker_mixer.h"
#include "pipeline/sound/wave_file.h"

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace stadion {

class SoundRecording final : public SoundSink {
public:
  /// `path` is asked for the file when the first sound plays.
  SoundRecording(const LoudspeakerSet& hall, const AssetRoots& roots, std::function<std::string()> path);

  /// Sounds go there as well; null: nowhere.
  void passTo(SoundSink* next) { next_ = next; }
  void play(SoundScape& scape, const SoundMix& mix) override;

  /// Completes the file. Nothing if all went well, or if there is none.
  std::optional<Diagnostic> finish();
  /// Returns the file; empty if no sound has played.
  const std::string& file() const { return file_; }
  std::uint64_t clipped() const { return wave_ ? wave_->clipped() : 0; }

private:
  struct Playing {
    SpeakerMixer::Voice voice = 0;
    Nanoseconds since = 0;
  };

  void record(const SoundScape& scape, const SoundMix& mix);
  void endVoices(const SoundScape& scape);
  void begin(const SoundRecord& sound, Playing& playing);
  void write(std::uint64_t frames);

  SpeakerMixer mixer_;
  SampleStore samples_;
  std::function<std::string()> path_;
  SoundSink* next_ = nullptr;
  std::string file_;
  std::unique_ptr<WaveFile> wave_;
  std::uint64_t silent_ = 0;           ///< frames before the first sound
  std::optional<Nanoseconds> before_;  ///< show time of the frame before
  std::map<NodeRef, Playing> playing_;
  std::vector<float> block_;
};

}  // namespace stadion
