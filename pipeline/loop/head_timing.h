#pragma once
/// Measures that bring a head's pose closer to the moment at which its picture is seen.
///
/// Threads  plain values.

#include "engine/base/time_signature.h"
#include "pipeline/view/head_reach.h"

#include <optional>

namespace stadion {

struct HeadTiming {
  static constexpr Nanoseconds kToSwap = -1;

  /// Late latch: Draw takes the newest pose within this reach. Nothing: it takes App's pose.
  std::optional<HeadReach> latch{};
  /// Prediction of the head's pose after its frame's start [ns]; kToSwap: for the time until the swap.
  /// Nothing: no prediction.
  std::optional<Nanoseconds> predict{};
};

}  // namespace stadion
