#include "assets/generator/craft/sounds.h"

#include "assets/generator/craft/geometry.h"

#include "engine/maths/functions.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace stadion::assets {
namespace {

std::size_t count(double seconds) {
  return static_cast<std::size_t>(seconds * kSoundRate);
}
double timeOf(std::size_t i) {
  return static_cast<double>(i) / kSoundRate;
}

/// White noise from -1 to 1 (xorshift, Marsaglia 2003).
class Noise {
public:
  explicit Noise(std::uint64_t seed) : state_(seed * 0x9e3779b97f4a7c15ULL + 1) {}
  double next() {
    state_ ^= state_ << 13, state_ ^= state_ >> 7, state_ ^= state_ << 17;
    return static_cast<double>(state_ >> 11) / 4503599627370496.0 - 1;
  }

private:
  std::uint64_t state_;
};

/// A state variable filter (Chamberlin 1985): what is near its frequency passes.
class Band {
public:
  double pass(double in, double frequency, double width) {
    const double f = 2 * det::sin(kPi * frequency / kSoundRate);
    low_ += f * band_;
    band_ += f * (in - low_ - width * band_);
    return band_ * width;
  }

private:
  double low_ = 0, band_ = 0;
};

/// From 0 at `from` to 1 at `to`, easily.
double rise(double t, double from, double to) {
  const double s = std::clamp((t - from) / (to - from), 0.0, 1.0);
  return s * s * (3 - 2 * s);
}

Samples loudest(Samples samples, double peak) {
  double most = 1e-9;
  for (const double s : samples) most = std::max(most, std::fabs(s));
  for (double& s : samples) s *= peak / most;
  return samples;
}

/// What comes after the loop's end fades out over its beginning.
Samples loopOf(const Samples& longer, std::size_t length) {
  Samples loop(longer.begin(), longer.begin() + static_cast<std::ptrdiff_t>(length));
  const std::size_t overlap = longer.size() - length;
  for (std::size_t i = 0; i < overlap; ++i) {
    const double s = static_cast<double>(i) / static_cast<double>(overlap);
    loop[i] = loop[i] * std::sqrt(s) + longer[length + i] * std::sqrt(1 - s);
  }
  return loop;
}

}  // namespace

Samples wind() {
  Samples out(count(5));
  Noise noise(1);
  Band deep, high;
  for (std::size_t i = 0; i < out.size(); ++i) {
    const double t = timeOf(i), white = noise.next();
    const double gust = 0.5 + 0.3 * det::sin(2 * kPi * t / 4) + 0.2 * det::sin(2 * kPi * t / 2 + 1);
    out[i] = deep.pass(white, 180 + 140 * gust, 0.5) * (0.5 + gust) +
             0.2 * high.pass(white, 900 + 500 * gust, 0.3) * gust;
  }
  return loudest(loopOf(out, count(4)), 0.5);
}

Samples cheer() {
  struct Voice {
    Noise noise;
    Band first, second;
    double begin, pitch, vowel, strength;
  };
  std::vector<Voice> crowd;
  Noise chance(7);
  for (std::uint64_t i = 0; i < 28; ++i)
    crowd.push_back({Noise(100 + i),
                     {},
                     {},
                     0.25 + 0.25 * chance.next(),
                     150 + 60 * chance.next(),
                     850 + 250 * chance.next(),
                     0.7 + 0.3 * chance.next()});
  Samples out(count(3.5));
  for (Voice& v : crowd) {
    double phase = 0;
    for (std::size_t i = 0; i < out.size(); ++i) {
      const double t = timeOf(i) - v.begin;
      if (t < 0) continue;
      // A hoarse voice that rises and falls: pulses and breath through two formants.
      const double pitch = v.pitch * (1 + 0.35 * rise(t, 0, 0.5) - 0.3 * rise(t, 1.2, 3));
      phase += pitch / kSoundRate;
      if (phase >= 1) phase -= 1;
      const double source = (phase < 0.1 ? 1 : -0.1) + 0.6 * v.noise.next();
      const double loud = v.strength * rise(t, 0, 0.35) * (1 - rise(timeOf(i), 1.6, 3.45));
      out[i] +=
          loud * (v.first.pass(source, v.vowel, 0.25) + 0.5 * v.second.pass(source, 2.1 * v.vowel, 0.2));
    }
  }
  // Hands.
  Noise clap(9);
  for (int n = 0; n < 160; ++n) {
    const std::size_t at = count(0.3 + 1.4 * (1 + chance.next()));
    const double loud = 0.8 * (1 - rise(timeOf(at), 1.8, 3.3));
    Band hand;
    const double tone = 1500 + 500 * chance.next();
    for (std::size_t i = 0; i < count(0.02) && at + i < out.size(); ++i)
      out[at + i] += loud * det::exp(-timeOf(i) / 0.004) * hand.pass(clap.next(), tone, 0.6);
  }
  return loudest(std::move(out), 0.8);
}

Samples trumpetCall() {
  struct Note {
    double begin, end, pitch;
  };
  constexpr std::array<Note, 3> kCall{{{0, 0.45, 294}, {0.5, 0.95, 440}, {1.0, 2.5, 587}}};
  Samples out(count(2.7));
  Noise breath(3);
  for (const Note& note : kCall) {
    double phase = 0;
    for (std::size_t i = count(note.begin); i < std::min(out.size(), count(note.end + 0.15)); ++i) {
      const double t = timeOf(i) - note.begin;
      phase +=
          note.pitch * (1 - 0.03 * (1 - rise(t, 0, 0.06)) + 0.004 * det::sin(2 * kPi * 5.2 * t)) / kSoundRate;
      if (phase >= 1) phase -= 1;
      const double loud = rise(t, 0, 0.05) * (1 - rise(timeOf(i), note.end - 0.08, note.end + 0.12));
      // Brass is brighter the louder it is: each harmonic comes in later.
      double tone = 0;
      for (int k = 1; k <= 14; ++k) {
        double part = 1.0 / k;
        for (int j = 1; j < k; j += 2) part *= 0.55 + 0.45 * loud;
        tone += part * det::sin(2 * kPi * k * phase);
      }
      out[i] += loud * (tone + 0.03 * breath.next());
    }
  }
  return loudest(std::move(out), 0.7);
}

Samples thud() {
  Samples out(count(0.6));
  Noise noise(5);
  Band earth, grit;
  double phase = 0;
  for (std::size_t i = 0; i < out.size(); ++i) {
    const double t = timeOf(i), white = noise.next();
    phase += (48 + 60 * det::exp(-t / 0.04)) / kSoundRate;
    out[i] = 0.9 * rise(t, 0, 0.003) * det::exp(-t / 0.09) * det::sin(2 * kPi * phase) +
             1.6 * det::exp(-t / 0.03) * earth.pass(white, 240, 0.7) +
             0.25 * det::exp(-t / 0.12) * grit.pass(white, 2400, 0.8);
  }
  return loudest(std::move(out), 0.9);
}

Samples whoosh() {
  Samples out(count(0.8));
  Noise noise(11);
  Band air, hiss;
  for (std::size_t i = 0; i < out.size(); ++i) {
    const double t = timeOf(i), white = noise.next();
    const double near = rise(t, 0, 0.34) * (1 - rise(t, 0.36, 0.78));
    out[i] = near * near *
             (air.pass(white, 350 + 900 * near, 0.35) + 0.3 * hiss.pass(white, 1800 + 1800 * near, 0.5));
  }
  return loudest(std::move(out), 0.7);
}

std::string toWav(const Samples& samples) {
  std::string bytes;
  const auto number = [&](std::uint32_t value, int size) {
    for (int i = 0; i < size; ++i) bytes += static_cast<char>(value >> 8 * i & 255);
  };
  const auto data = static_cast<std::uint32_t>(2 * samples.size());
  bytes += "RIFF", number(36 + data, 4), bytes += "WAVEfmt ";
  number(16, 4), number(1, 2), number(1, 2), number(kSoundRate, 4), number(2 * kSoundRate, 4);
  number(2, 2), number(16, 2);
  bytes += "data", number(data, 4);
  for (const double s : samples) {
    const double scaled = std::clamp(s, -1.0, 1.0) * 32767;
    number(static_cast<std::uint32_t>(static_cast<std::int32_t>(scaled + (scaled < 0 ? -0.5 : 0.5))), 2);
  }
  return bytes;
}

}  // namespace stadion::assets
