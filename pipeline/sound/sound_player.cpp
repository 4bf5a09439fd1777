#include "pipeline/sound/sound_player.h"

#include <algorithm>
#include <cmath>
#include <exception>

namespace stadion {
namespace {

constexpr double kNoticeable = 0.05;  ///< a start that is later than this begins inside the sound [s]

}  // namespace

double loudnessAt(double distance, double range) {
  if (range <= 0) return 1;
  const double left = 1 - distance / range;
  return left > 0 ? left * left : 0;
}

SoundPlayer::SoundPlayer(const AssetRoots& roots, std::function<void(const std::string&)> tell,
                         OpenDevice open)
    : tell_(std::move(tell)), open_(std::move(open)), samples_(roots), thread_([this] { work(); }) {}

SoundPlayer::~SoundPlayer() {
  {
    const std::lock_guard lock(mutex_);
    ending_ = true;
    changed_.notify_all();
  }
  thread_.join();
}

void SoundPlayer::play(SoundScape& scape, const SoundMix& mix) {
  if (scape.sounds.empty() && silent_) return;
  silent_ = scape.sounds.empty();
  const std::lock_guard lock(mutex_);
  std::swap(next_, scape);
  nextMix_ = mix;
  fresh_ = true;
  changed_.notify_all();
}

void SoundPlayer::waitUntilPlayed() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [&] { return !fresh_ && !busy_; });
}

void SoundPlayer::work() {
  SoundScape scape;
  std::unique_lock lock(mutex_);
  for (;;) {
    changed_.wait(lock, [&] { return ending_ || fresh_; });
    if (ending_) break;
    std::swap(scape, next_);
    const SoundMix mix = nextMix_;
    fresh_ = false;
    busy_ = true;
    lock.unlock();
    try {
      follow(scape, mix);
    } catch (const std::exception&) {
      // Out of memory: this frame's sounds are missing, but the show goes on. They are started later.
      std::erase_if(playing_, [](const auto& p) { return p.second.voice == 0; });
      samples_.forgetMissing();
    }
    lock.lock();
    busy_ = false;
    changed_.notify_all();
  }
  lock.unlock();
  device_.reset();
}

void SoundPlayer::openDevice() {
  opened_ = true;
  auto device = open_();
  if (device) device_ = std::move(device.value());
  tell_(device_ ? "sound: " + device_->name()
                : "sound: " + device.error().message + "; the show is played silently");
}

void SoundPlayer::follow(const SoundScape& scape, const SoundMix& mix) {
  if (!opened_ && !scape.sounds.empty()) openDevice();
  if (!device_) return;
  if (volume_ != mix.volume) device_->setVolume(volume_ = mix.volume);
  std::erase_if(playing_, [&](const auto& p) {
    const auto same = [&](const SoundRecord& s) { return s.node == p.first && s.since == p.second.since; };
    if (std::ranges::any_of(scape.sounds, same)) return false;
    device_->stop(p.second.voice);
    return true;
  });
  const Pose X_HW = scape.X_WH.inverse(), X_RW = scape.X_WR.inverse();
  for (const SoundRecord& s : scape.sounds) {
    const auto [at, isNew] = playing_.try_emplace(s.node);
    if (isNew) begin(s, scape.time, at->second);
    Playing& p = at->second;
    if (p.voice == 0) continue;
    const Vec3 p_H = X_HW * s.position;
    const Vec3 heard = device_->standsInRoom() ? X_RW.q * (s.position - scape.X_WH.p) : p_H;
    device_->set(p.voice, s.gain * loudnessAt(p_H.norm(), s.range), s.range > 0 ? heard : Vec3::Zero());
    if (p.paused != mix.paused) device_->pause(p.voice, p.paused = mix.paused);
  }
}

void SoundPlayer::begin(const SoundRecord& sound, Nanoseconds now, Playing& playing) {
  playing.since = sound.since;
  const auto samples = samples_.samplesOf(sound);
  if (!samples) return;
  double late = std::max(0.0, toSeconds(now - sound.since));
  if (sound.loop) late = std::fmod(late, std::max(1e-3, toSeconds(samples->info.length())));
  playing.voice = device_->start(samples, sound.loop, late > kNoticeable ? late : 0);
}

}  // namespace stadion
