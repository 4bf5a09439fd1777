#pragma once
/// Plays a test show in this process, so that a test can look into it.

#include "show/player/player.h"

#include <memory>
#include <string>

namespace stadion {

/// One of tests/corpus/shows, or any script, ready to be played. Null, with the findings told, if it is
/// wrong.
std::unique_ptr<Player> openShow(const std::string& script, const std::string& walls = "desktop");

/// Plays `frames` frames with these parts.
FrameLoopOutcome play(ShowStages& stages, Mode mode, std::size_t walls, std::uint64_t frames,
                      double rate = 60);

/// A show that a test plays frame by frame at 60 Hz, without drawing it.
struct SteppedShow {
  void play(std::uint64_t frames);

  std::unique_ptr<Player> player;
  InputSample input;
  ChangeSet changes;       ///< of the last frame
  std::uint64_t next = 0;  ///< number of the next frame
};

}  // namespace stadion
