#pragma once
/// How a head's pose is brought closer to the moment at which its picture is seen.
///
/// Threads  plain values.

#include "engine/base/time_signature.h"
#include "pipeline/view/head_reach.h"

#include <optional>

namespace stadion {

struct HeadTiming {
  static constexpr Nanoseconds kToSwap = -1;

  /// Late latch: Draw takes the newest pose, as far as it lies within. Nothing: it takes App's.
  std::optional<HeadReach> latch{};
  /// How far ahead of its frame's start the head is told [ns]; kToSwap: as long as frames take to their swap.
  /// Nothing: as it is.
  std::optional<Nanoseconds> predict{};
};

}  // namespace stadion
