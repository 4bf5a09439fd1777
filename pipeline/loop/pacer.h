#pragma once
/// Decides when the next frame may begin.
///
/// Threads  App only; missed() after the run as well.

#include "engine/base/time_signature.h"

#include "engine/core/pace.h"

#include <chrono>
#include <cstdint>

namespace stadion {

class Pacer {
public:
  /// With `everyTick` no tick is skipped: late frames begin at once until they have caught up (Float: the
  /// ticks wait).
  Pacer(Pace pace, double rate, bool everyTick = false);

  /// Starts late by `by`. Frames are simulated tick by tick until they catch up, for at most `by`; later
  /// ticks are skipped as usual. Call it before the first wait(). It has no effect on a pacer that waits for
  /// no ticks.
  void startLate(std::chrono::nanoseconds by) {
    startsLate_ = std::chrono::duration_cast<Clock::duration>(by);
  }
  /// Returns true while frames catch up.
  bool catchesUp() const { return started_ && Clock::now() < catchUpUntil_; }
  /// Waits until the next frame may begin. Returns the number of ticks since the previous one; normally 1.
  std::uint64_t wait();
  /// The loop was stopped for so long: the coming ticks are moved by as much.
  void hold(std::chrono::steady_clock::duration by);
  /// Returns true if the next frame is late already.
  bool behind() const { return pace_ != Pace::Free && started_ && Clock::now() > next_; }
  /// Returns the ticks that passed without the start of a frame.
  std::uint64_t missed() const { return missed_; }

private:
  using Clock = std::chrono::steady_clock;

  Pace pace_;
  bool everyTick_;
  Clock::duration period_;
  Clock::time_point next_;
  Clock::duration startsLate_{};
  Clock::time_point catchUpUntil_{};
  bool started_ = false;
  std::uint64_t missed_ = 0;
};

}  // namespace stadion
