#pragma once
/// Decides how a show continues after its player has crashed: from the saved scene, from its start, or not at
/// all.
///
/// The first crash restarts the player at once. A crash counts as one in a row if it comes before the show is
/// kSteady past the place of the last crash, and before the player has played for kLong. For crashes in a row
/// the pause before each restart doubles. After kFromScene crashes the saved scene is no longer trusted;
/// after kMost the show is given up. All limits are times, so they are the same at every rate.
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

  enum class Way { GoOn, Restart, GiveUp };
  struct Step {
    Way way;
    Milliseconds pause;  ///< before the next player is started
  };
  /// Reports a crash at that show time. `played`: how long the player had played since it caught up.
  Step died(Nanoseconds time, Nanoseconds played);
  /// Returns the number of crashes in a row.
  std::size_t deaths() const { return deaths_; }

private:
  std::size_t deaths_ = 0;
  Nanoseconds steadyAt_ = 0;  ///< show time at which the place of the last crash is safely passed
};

}  // namespace stadion
