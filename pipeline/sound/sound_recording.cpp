#include "pipeline/sound/sound_recording.h"

#include "pipeline/sound/sound_player.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace stadion {
namespace {

constexpr std::uint64_t kMostSoundAtOnce = 4096;  ///< frames of sound

/// The frame of sound that is nearest to a show time.
std::int64_t soundFrameAt(Nanoseconds time) {
  constexpr std::int64_t kSecond = 1'000'000'000;
  return time / kSecond * SpeakerMixer::kRate +
         (time % kSecond * SpeakerMixer::kRate + kSecond / 2) / kSecond;
}

}  // namespace

SoundRecording::SoundRecording(const LoudspeakerSet& hall, const AssetRoots& roots,
                               std::function<std::string()> path)
    : mixer_(hall), samples_(roots), path_(std::move(path)) {}

void SoundRecording::play(SoundScape& scape, const SoundMix& mix) {
  record(scape, mix);
  if (next_) next_->play(scape, mix);
}

void SoundRecording::record(const SoundScape& scape, const SoundMix& mix) {
  // The next group's show restarts at 0.
  if (before_ && scape.time < *before_) {
    for (auto& [node, p] : std::exchange(playing_, {})) mixer_.stop(p.voice);
    before_ = scape.time;
  }
  const bool isFirst = !before_;
  if (isFirst) before_ = scape.time;
  const auto frames = static_cast<std::uint64_t>(soundFrameAt(scape.time) - soundFrameAt(*before_));
  const auto ramp = static_cast<std::uint32_t>(std::min<std::uint64_t>(frames, kMostSoundAtOnce));
  if (frames == 0 && !isFirst) return;  // the show stands still
  endVoices(scape);
  mixer_.setVolume(mix.volume, ramp);
  const Pose X_RW = scape.X_WR.inverse();
  for (const SoundRecord& s : scape.sounds) {
    const auto [at, isNew] = playing_.try_emplace(s.node);
    if (isNew) begin(s, at->second);
    const Vec3 away = s.position - scape.X_WH.p;
    mixer_.set(at->second.voice, s.gain * loudnessAt(away.norm(), s.range),
               s.range > 0 ? Vec3(X_RW.q * away) : Vec3(Vec3::Zero()), ramp);
  }
  before_ = scape.time;
  write(frames);
}

void SoundRecording::endVoices(const SoundScape& scape) {
  std::erase_if(playing_, [&](const auto& p) {
    const auto same = [&](const SoundRecord& s) { return s.node == p.first && s.since == p.second.since; };
    if (std::ranges::any_of(scape.sounds, same)) return false;
    mixer_.stop(p.second.voice);
    return true;
  });
}

/// A sound that began within the frame begins there; one from before is entered in the middle.
void SoundRecording::begin(const SoundRecord& sound, Playing& playing) {
  playing.since = sound.since;
  const auto samples = samples_.samplesOf(sound);
  if (!samples) return;
  const Nanoseconds start = std::max(sound.since, *before_);
  double late = toSeconds(start - sound.since);
  if (sound.loop) late = std::fmod(late, std::max(1e-3, toSeconds(samples->info.length())));
  const auto after = static_cast<std::uint32_t>(soundFrameAt(start) - soundFrameAt(*before_));
  playing.voice = mixer_.start(samples, sound.loop, late, after);
  if (wave_) return;
  file_ = path_();
  wave_ = std::make_unique<WaveFile>(file_, mixer_.channels(), SpeakerMixer::kRate);
  block_.assign(kMostSoundAtOnce * mixer_.channels(), 0);
  for (std::uint64_t left = silent_; left > 0; left -= std::min(left, kMostSoundAtOnce))
    wave_->write(std::span(block_).first(std::min(left, kMostSoundAtOnce) * mixer_.channels()));
}

void SoundRecording::write(std::uint64_t frames) {
  if (!wave_) {
    silent_ += frames;
    return;
  }
  for (; frames > 0; frames -= std::min(frames, kMostSoundAtOnce)) {
    const auto part = std::span(block_).first(std::min(frames, kMostSoundAtOnce) * mixer_.channels());
    mixer_.mix(part);
    wave_->write(part);
  }
}

std::optional<Diagnostic> SoundRecording::finish() {
  return wave_ ? wave_->finish() : std::nullopt;
}

}  // namespace stadion
