#pragma once
/// How long after a frame's start its pictures are shown: what the last frames took, the middle one.
///
/// Threads  note() by whoever swaps; expected() by any.

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
  /// 0 until a frame has been shown [ns].
  Nanoseconds expected() const { return expected_; }

private:
  static constexpr std::size_t kLooksBack = 15;  ///< frames

  std::array<Nanoseconds, kLooksBack> took_{};
  std::size_t count_ = 0;
  std::atomic<Nanoseconds> expected_ = 0;
};

}  // namespace stadion
