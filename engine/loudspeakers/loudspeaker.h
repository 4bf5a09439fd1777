#pragma once
/// Loudspeakers of a hall: where they stand, and how they are brought to the same time and level.
///
/// A loudspeaker that is farther away is heard later and softer. So the nearer ones are delayed and attenuated,
/// until all sound as if they stood at the distance of the farthest one (soundAlignment()).
///
/// Frames   rig space (+X right, +Y forward, +Z up).
/// Units    metres; delays in seconds; gains are factors of the amplitude.
/// Threads  plain values, any thread.
/// Sources  sound travels at 343 m/s in dry air of 20 degrees Celsius; its amplitude falls with distance.

#include "engine/maths/maths.h"

#include <cstdint>
#include <string>
#include <vector>

namespace stadion {

struct Loudspeaker {
  std::string name;
  Vec3 place = Vec3::Zero();  ///< [m]
  std::uint32_t channel = 0;  ///< of the sound output, from 0
  double delay = 0;           ///< in addition to the alignment [s]
  double gain = 1;            ///< in addition to the alignment [1]
  double crossover = 0;       ///< a subwoofer: plays all sounds below this frequency [Hz]; 0: it is none
  std::uint32_t line = 0;     ///< in the file; 0 = made by a program
  std::uint32_t column = 0;   ///< column of its name
  std::string excerpt{};      ///< the line, for messages

  bool isSubwoofer() const { return crossover > 0; }
};

/// All loudspeakers of a hall, and what they are connected to.
struct LoudspeakerSet {
  static constexpr std::size_t kMost = 64;
  static constexpr std::uint32_t kMostChannels = 64;

  std::vector<Loudspeaker> all;
  std::string card;            ///< name of the ALSA device; empty: "default"
  bool aligned = true;         ///< Stadion aligns them; false: a sound processor of the hall does
  Vec3 ear = Vec3(0, 0, 1.7);  ///< usual place of the visitor's head: the alignment is right there [m]
  double reach = 1;            ///< how far the head goes from there [m]

  bool empty() const { return all.empty(); }
  /// Channels of the sound output: as many as the highest number needs.
  std::uint32_t channels() const {
    std::uint32_t count = 0;
    for (const Loudspeaker& s : all) count = s.channel + 1 > count ? s.channel + 1 : count;
    return count;
  }
};

constexpr double kSpeedOfSound = 343;  ///< [m/s]

struct SoundAlignment {
  double delay = 0;  ///< [s]
  double gain = 1;   ///< [1]
};

/// Delay and gain of each loudspeaker, with those that the file adds. A distance below 0.1 m counts as 0.1 m.
std::vector<SoundAlignment> soundAlignment(const LoudspeakerSet& hall);

}  // namespace stadion
