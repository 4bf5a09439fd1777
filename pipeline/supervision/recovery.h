#pragma once
/// How a show goes on after its player has died: from the scene that was kept, from its start, or not at all.
///
/// The first time at once. A player that dies again before the show has got kSteady past where the one before
/// died, and before it has played for kLong, has died in a row: the pauses before the next one double, after
/// kFromScene deaths the kept scene is not trusted any more, after kMost the show is given up. All of this
/// goes by time, so that it is the same at every rate.
///
/// Threads  one at a time.

#include "engine/base/time_signature.h"

#include <chrono>
#include <cstddef>

namespace stadion {

class Recovery {
public:
  using Milliseconds = std::chrono::milliseconds;

  static constexpr Nanoseconds kSteady = fromSeconds(5), kLong = fromSeconds(180);
  static constexpr std::size_t kFromScene = 5, kMost = 10;
  static constexpr Milliseconds kShortest{250}, kLongest{30'000};

  enum class Way { GoOn, BeginAgain, GiveUp };
  struct Step {
    Way way;
    Milliseconds pause;  ///< before the next player is started
  };
  /// The player has died at that show time; for so long it had played what it had not to catch up with.
  Step died(Nanoseconds time, Nanoseconds played);
  /// Deaths in a row.
  std::size_t deaths() const { return deaths_; }

private:
  std::size_t deaths_ = 0;
  Nanoseconds steadyAt_ = 0;  ///< show time beyond the place of the last death
};

}  // namespace stadion
