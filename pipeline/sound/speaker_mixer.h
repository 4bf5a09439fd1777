#pragma once
/// Mixes sounds for the loudspeakers of a hall: pans each sound, then delays and scales each loudspeaker.
///
/// Nothing clicks: gains run linearly from their old values to new ones, and a voice that is stopped or paused
/// fades out. Only a voice that starts does so at once, because the attack of a sound is part of it. Samples
/// depend on the calls and their order alone, never on a clock. So a recording is the same on every machine.
///
/// Subwoofers play the sum of all sounds below their crossover frequency, by a Linkwitz-Riley low-pass of fourth
/// order. The other loudspeakers play the whole range.
///
/// Frames     rig space, seen from the ears [m].
/// Units      frames of sound are a sample for each channel; time is counted in them.
/// Threads    one at a time.
/// Ownership  a voice shares the samples of its sound.
/// Errors     samples beyond full scale are left as they are; the output clips them.
/// Sources    J. O. Smith, "Introduction to Digital Filters", 2007 (the bilinear transform);
///            S. Linkwitz, "Active Crossover Networks for Noncoincident Drivers", J. Audio Eng. Soc. 24(1), 1976.

#include "engine/asset/sound_file.h"
#include "engine/loudspeakers/loudspeaker.h"
#include "pipeline/sound/speaker_panning.h"

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <vector>

namespace stadion {

class SpeakerMixer {
public:
  using Voice = std::uint32_t;
  static constexpr std::uint32_t kRate = 48'000;  ///< of the output [1/s]
  static constexpr std::uint32_t kFade = 240;     ///< of a voice that stops: 5 ms [frames]

  /// Expects at least one loudspeaker that is no subwoofer.
  explicit SpeakerMixer(const LoudspeakerSet& hall);

  std::uint32_t channels() const { return channels_; }

  /// Plays the sound from `offset` [s] on, silently until the first set(). `after`: so many frames of the next
  /// mix() pass before it.
  Voice start(std::shared_ptr<const Sound> sound, bool loop, double offset, std::uint32_t after = 0);
  /// Sets volume (0 to 1) and place, seen from the ears. A sound at the origin comes from all around. The gains
  /// reach them within `ramp` frames; the first time they have them at once.
  void set(Voice voice, double gain, const Vec3& place, std::uint32_t ramp);
  void stop(Voice voice);
  void pause(Voice voice, bool paused);
  /// Of all voices, from 0 to 1.
  void setVolume(double volume, std::uint32_t ramp);

  /// Fills the next frames: (frames x channels), interleaved. Channels without a loudspeaker are silent.
  void mix(std::span<float> out);
  /// Returns the number of voices that still sound.
  std::size_t voices() const { return playing_.size(); }

private:
  /// A value that runs to its target.
  struct Ramp {
    double now = 0, step = 0, target = 0;
    std::uint32_t left = 0;

    void aim(double to, std::uint32_t frames);
    double next();
  };
  struct Playing {
    std::shared_ptr<const Sound> sound;
    double at = 0;  ///< of the sound [samples]
    std::uint32_t after = 0;
    bool loop = false, isSet = false, ends = false, paused = false;
    std::array<std::vector<Ramp>, 2> gains{};  ///< by channel of the sound, then by loudspeaker
    Ramp level{1, 0, 1, 0};                    ///< fades it in and out
    Ramp bass{};                               ///< its share in the subwoofers
  };
  /// A low-pass of second order.
  struct LowPass {
    double b0 = 0, b1 = 0, b2 = 0, a1 = 0, a2 = 0, z1 = 0, z2 = 0;
    double next(double x);
  };
  struct Output {
    std::uint32_t channel = 0;
    double gain = 1;
    std::vector<double> line{};  ///< the last samples; its length is the delay
    std::size_t at = 0;
    bool isBass = false;
    std::array<LowPass, 2> low{};  ///< of a subwoofer
  };

  void add(Playing& voice, std::size_t frames);
  static LowPass lowPassAt(double hertz);

  std::uint32_t channels_;
  std::vector<Output> outputs_;  ///< first those that are panned, then subwoofers
  std::size_t panned_;           ///< number of the first ones
  SpeakerPanning panning_;
  Ramp volume_{1, 0, 1, 0};
  std::map<Voice, Playing> playing_;
  Voice last_ = 0;
  std::vector<double> sums_, bass_;  ///< (frames x panned) and (frames) of the present mix()
};

}  // namespace stadion
