#pragma once
/// Predicts the time from a frame's start to its swap: the median of the last frames.
///
/// Threads  note() on the thread that swaps; expected() from any.

#include "engine/base/time_signature.h"

#include <array>
#include <atomic>
#include <chrono>
#include <cstddef>

namespace stadion {

class SwapForecast {
public:
  using Clock = std::chrono::steady_clock;

  void note(Clock::duration startToSwap);
  /// Returns 0 until a frame has been shown [ns].
  Nanoseconds expected() const { return expected_; }

private:
  static constexpr std::size_t kLooksBack = 15;  ///< frames

  std::array<Nanoseconds, kLooksBack> took_{};
  std::size_t count_ = 0;
  std::atomic<Nanoseconds> expected_ = 0;
};

}  // namespace stadion
