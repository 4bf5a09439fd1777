#include "engine/loudspeakers/loudspeaker.h"

#include <algorithm>

namespace stadion {

std::vector<SoundAlignment> soundAlignment(const LoudspeakerSet& hall) {
  constexpr double kNearest = 0.1;
  const auto distanceOf = [&](const Loudspeaker& s) {
    return std::max(kNearest, (s.place - hall.ear).norm());
  };
  double farthest = 0;
  for (const Loudspeaker& s : hall.all) farthest = std::max(farthest, distanceOf(s));
  std::vector<SoundAlignment> all;
  for (const Loudspeaker& s : hall.all) {
    SoundAlignment a{s.delay, s.gain};
    if (hall.aligned) {
      a.delay += (farthest - distanceOf(s)) / kSpeedOfSound;
      a.gain *= distanceOf(s) / farthest;
    }
    all.push_back(a);
  }
  return all;
}

}  // namespace stadion
