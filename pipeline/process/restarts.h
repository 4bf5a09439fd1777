#pragma once
/// When a process that crashed is restarted, and what the log says about it.
///
/// After its first crash a process restarts at once. After further crashes within kSteady frames, the pause
/// before each restart doubles. Only the first two are reported. So a wall that cannot be drawn costs the
/// others nothing.
///
/// Threads  one at a time.

#include <chrono>
#include <cstddef>

namespace stadion::wall_process {

class Restarts {
public:
  using Clock = std::chrono::steady_clock;
  using Milliseconds = std::chrono::milliseconds;

  static constexpr std::size_t kSteady = 300;  ///< frames
  static constexpr Milliseconds kShortest{250}, kLongest{30'000};

  enum class Death { First, Second, Further };
  /// Notes that the process died or could not be started.
  Death died(Clock::time_point now);
  /// Returns true if the next one may be started.
  bool due(Clock::time_point now) const { return now >= next_; }
  /// Notes that the process has drawn a frame. Returns true if the wall may be reported as back.
  bool drew();
  /// Deaths in a row.
  std::size_t deaths() const { return deaths_; }

private:
  std::size_t drawn_ = 0;   ///< since it was started
  std::size_t deaths_ = 0;  ///< in a row
  Clock::time_point next_{};
};

}  // namespace stadion::wall_process
