#include "pipeline/sound/speaker_mixer.h"

#include "engine/maths/angles.h"
#include "engine/maths/functions.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace stadion {
namespace {

std::vector<Vec3> pannedDirections(const LoudspeakerSet& hall) {
  std::vector<Vec3> all;
  for (const Loudspeaker& s : hall.all) {
    const Vec3 d = s.place - hall.ear;
    if (!s.isSubwoofer()) all.push_back(d.isZero() ? Vec3(0, 1, 0) : d);
  }
  return all;
}

/// A sample between two, by the cubic through the four around it (Catmull-Rom).
double betweenSamples(double before, double a, double b, double after, double part) {
  const double c1 = 0.5 * (b - before), c2 = before - 2.5 * a + 2 * b - 0.5 * after,
               c3 = 0.5 * (after - before) + 1.5 * (a - b);
  return a + part * (c1 + part * (c2 + part * c3));
}

/// A sample of a sound, -1 to 1. Beyond its ends there is silence, or the other end of a loop.
double sampleAt(const Sound& sound, std::int64_t index, std::uint32_t channel, bool loop) {
  const auto length = static_cast<std::int64_t>(sound.info.samples);
  if (loop)
    index = ((index % length) + length) % length;
  else if (index < 0 || index >= length)
    return 0;
  const std::size_t at = static_cast<std::size_t>(index) * sound.info.channels + channel;
  return at < sound.samples.size() ? sound.samples[at] / 32768.0 : 0;
}

double valueAt(const Sound& sound, double at, std::uint32_t channel, bool loop) {
  const double whole = std::floor(at), part = at - whole;
  const auto i = static_cast<std::int64_t>(whole);
  if (part == 0) return sampleAt(sound, i, channel, loop);
  return betweenSamples(sampleAt(sound, i - 1, channel, loop), sampleAt(sound, i, channel, loop),
                        sampleAt(sound, i + 1, channel, loop), sampleAt(sound, i + 2, channel, loop), part);
}

}  // namespace

void SpeakerMixer::Ramp::aim(double to, std::uint32_t frames) {
  target = to;
  left = now == to ? 0 : frames;
  step = left > 0 ? (to - now) / left : 0;
  if (left == 0) now = to;
}

double SpeakerMixer::Ramp::next() {
  if (left > 0) now = --left == 0 ? target : now + step;
  return now;
}

double SpeakerMixer::LowPass::next(double x) {
  const double y = b0 * x + z1;
  z1 = b1 * x - a1 * y + z2;
  z2 = b2 * x - a2 * y;
  return y;
}

/// Two of these in a row make a Linkwitz-Riley low-pass: each is a Butterworth low-pass.
SpeakerMixer::LowPass SpeakerMixer::lowPassAt(double hertz) {
  const auto [sine, cosine] = det::sincos(2 * kPi * hertz / kRate);
  const double alpha = sine / std::sqrt(2.0), a0 = 1 + alpha;
  LowPass f;
  f.b0 = f.b2 = (1 - cosine) / 2 / a0;
  f.b1 = (1 - cosine) / a0;
  f.a1 = -2 * cosine / a0;
  f.a2 = (1 - alpha) / a0;
  return f;
}

SpeakerMixer::SpeakerMixer(const LoudspeakerSet& hall)
    : channels_(hall.channels()), panned_(0), panning_(pannedDirections(hall)) {
  const std::vector<SoundAlignment> aligned = soundAlignment(hall);
  for (const bool bass : {false, true})
    for (std::size_t i = 0; i < hall.all.size(); ++i) {
      const Loudspeaker& s = hall.all[i];
      if (s.isSubwoofer() != bass) continue;
      Output& o = outputs_.emplace_back();
      o.channel = s.channel;
      o.gain = aligned[i].gain;
      o.line.assign(static_cast<std::size_t>(std::lround(aligned[i].delay * kRate)), 0);
      o.isBass = bass;
      if (bass) o.low.fill(lowPassAt(s.crossover));
      panned_ += !bass;
    }
}

SpeakerMixer::Voice SpeakerMixer::start(std::shared_ptr<const Sound> sound, bool loop, double offset,
                                        std::uint32_t after) {
  if (!sound || sound->info.samples == 0 || sound->info.rate == 0 || sound->info.channels == 0) return 0;
  Playing& p = playing_[++last_];
  p.at = std::max(0.0, offset) * sound->info.rate;
  p.after = after;
  p.loop = loop;
  for (std::uint32_t c = 0; c < std::min(2u, sound->info.channels); ++c) p.gains[c].resize(panned_);
  p.sound = std::move(sound);
  return last_;
}

void SpeakerMixer::set(Voice voice, double gain, const Vec3& place, std::uint32_t ramp) {
  const auto at = playing_.find(voice);
  if (at == playing_.end()) return;
  Playing& p = at->second;
  if (!std::exchange(p.isSet, true)) ramp = 0;
  const bool isStereo = !p.gains[1].empty();
  std::vector<double> shares(panned_);
  for (std::size_t c = 0; c < (isStereo ? 2u : 1u); ++c) {
    if (!place.isZero())
      panning_.gainsOf(place, shares);
    else if (isStereo)
      panning_.gainsOfSide(c == 0 ? -1 : 1, shares);
    else
      panning_.gainsAround(shares);
    for (std::size_t s = 0; s < panned_; ++s) p.gains[c][s].aim(gain * shares[s], ramp);
  }
  p.bass.aim(gain, ramp);
}

void SpeakerMixer::stop(Voice voice) {
  const auto at = playing_.find(voice);
  if (at == playing_.end()) return;
  Playing& p = at->second;
  p.ends = true;
  p.level.aim(0, p.paused || !p.isSet ? 0 : kFade);
}

void SpeakerMixer::pause(Voice voice, bool paused) {
  const auto at = playing_.find(voice);
  if (at == playing_.end() || at->second.ends || at->second.paused == paused) return;
  at->second.paused = paused;
  at->second.level.aim(paused ? 0 : 1, kFade);
}

void SpeakerMixer::setVolume(double volume, std::uint32_t ramp) {
  volume_.aim(volume, ramp);
}

/// Adds the next frames of a voice to the sums.
void SpeakerMixer::add(Playing& p, std::size_t frames) {
  const Sound& sound = *p.sound;
  const double step = static_cast<double>(sound.info.rate) / kRate;
  const auto length = static_cast<double>(sound.info.samples);
  const std::uint32_t sources = p.gains[1].empty() ? 1 : 2;
  for (std::size_t i = 0; i < frames; ++i) {
    if (p.after > 0) {
      --p.after;
      continue;
    }
    if (p.level.left == 0 && p.level.now == 0) return;  // it is paused, or has ended
    const double level = p.level.next();
    double all = 0;
    for (std::uint32_t c = 0; c < sources; ++c) {
      const double x = level * valueAt(sound, p.at, c, p.loop);
      all += x / sources;
      double* sum = &sums_[i * panned_];
      for (Ramp& gain : p.gains[c]) *sum++ += gain.next() * x;
    }
    bass_[i] += p.bass.next() * all;
    p.at += step;
    if (p.loop)
      while (p.at >= length) p.at -= length;
    else if (p.at >= length) {
      p.ends = true;
      p.level = {};
    }
  }
}

void SpeakerMixer::mix(std::span<float> out) {
  const std::size_t frames = out.size() / channels_;
  sums_.assign(frames * panned_, 0);
  bass_.assign(frames, 0);
  for (auto& [number, voice] : playing_) add(voice, frames);
  std::erase_if(playing_, [](const auto& v) {
    const Playing& p = v.second;
    return p.ends && p.level.left == 0 && p.level.now == 0;
  });
  std::ranges::fill(out, 0.0f);
  for (std::size_t i = 0; i < frames; ++i) {
    const double volume = volume_.next();
    for (std::size_t s = 0; s < outputs_.size(); ++s) {
      Output& o = outputs_[s];
      double x = volume * o.gain * (o.isBass ? bass_[i] : sums_[i * panned_ + s]);
      if (o.isBass)
        for (LowPass& f : o.low) x = f.next(x);
      if (!o.line.empty()) {
        std::swap(x, o.line[o.at]);
        o.at = o.at + 1 == o.line.size() ? 0 : o.at + 1;
      }
      out[i * channels_ + o.channel] += static_cast<float>(x);
    }
  }
}

}  // namespace stadion
