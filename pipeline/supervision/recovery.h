#pragma once
/// How a show goes on after its player has died: from the scene that was kept, from its start, or not at all.
///
/// The first time at once. A player that dies again before the show has got kSteady frames past where the one
/// before died, and before it has shown kLong frames, has died in a row: the pauses before the next one
/// double, after kFromScene deaths the kept scene is not trusted any more, after kMost the show is given up.
///
/// Threads  one at a time.

#include <chrono>
#include <cstddef>
#include <cstdint>

namespace stadion {

class Recovery {
public:
  using Milliseconds = std::chrono::milliseconds;

  static constexpr std::uint64_t kSteady = 300, kLong = 10'000;  ///< frames
  static constexpr std::size_t kFromScene = 5, kMost = 10;
  static constexpr Milliseconds kShortest{250}, kLongest{30'000};

  enum class Way { GoOn, BeginAgain, GiveUp };
  struct Step {
    Way way;
    Milliseconds pause;  ///< before the next player is started
  };
  /// The player has died; `frame` was the newest one, and it had shown so many.
  Step died(std::uint64_t frame, std::uint64_t shown);
  /// Deaths in a row.
  std::size_t deaths() const { return deaths_; }

private:
  std::size_t deaths_ = 0;
  std::uint64_t steadyAt_ = 0;  ///< a frame beyond the place of the last death
};

}  // namespace stadion
