#pragma once
/// When the next frame may begin.

#include "engine/base/time_signature.h"

#include <chrono>
#include <cstdint>

namespace stadion {

/// What happens to the frame rate (IRIS Performer's phases).
enum class Pace {
  Free,   ///< as fast as possible
  Lock,   ///< frames begin on ticks of the rate; after a missed tick the next one is waited for
  Float,  ///< a frame that missed its tick begins at once, and the ticks move with it
};

class Pacer {
public:
  /// With `everyTick` none is left out: what is late begins at once, until it has caught up (Float: the ticks
  /// wait).
  Pacer(Pace pace, double rate, bool everyTick = false);

  /// The first frame is that much late. It and those after it are simulated one by one until they have
  /// caught up, for as long again at most; what is late still is then left out as ever. Before the first
  /// wait(). Without effect where nobody waits for ticks.
  void startLate(std::chrono::nanoseconds by) {
    startsLate_ = std::chrono::duration_cast<Clock::duration>(by);
  }
  /// Whether that is going on.
  bool catchesUp() const { return started_ && Clock::now() < catchUpUntil_; }
  /// Waits until the next frame may begin. Returns how many ticks have passed since the previous one: 1 when
  /// all is well.
  std::uint64_t wait();
  /// Nothing could go on for so long: the ticks to come are as much later.
  void hold(std::chrono::steady_clock::duration by);
  /// Whether the next frame is late already.
  bool behind() const { return pace_ != Pace::Free && started_ && Clock::now() > next_; }
  /// Ticks that passed without a frame beginning.
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
