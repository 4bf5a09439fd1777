#pragma once
/// What receives the sounds of each frame: a player, a recording, or both.
///
/// Threads  App.

#include "engine/published/sound_scape.h"

namespace stadion {

/// The operator's settings for the show's sounds.
struct SoundMix {
  double volume = 1;  ///< from 0 to 1
  bool paused = false;

  bool operator==(const SoundMix&) const = default;
};

class SoundSink {
public:
  virtual ~SoundSink() = default;
  /// Sets the sounds from now on. Takes the scape's content, and returns memory to fill.
  virtual void play(SoundScape& scape, const SoundMix& mix) = 0;
};

}  // namespace stadion
