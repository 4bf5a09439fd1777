#pragma once
/// How far a head may go between Cull and Draw, where Draw takes the newest pose (loop/head_latch.h):
/// Cull looks for what may be seen from anywhere within, and no picture is drawn from beyond.
///
/// Units    metres, radians.
/// Threads  plain values and pure functions.

#include "engine/maths/maths.h"

namespace stadion {

struct HeadReach {
  double metres = 0;   ///< from where the head was
  double radians = 0;  ///< from how it was turned

  /// How far that takes the eyes at most [m]. `separation`: between them [m].
  double ofEyes(double separation) const;
  /// `to`, or as much of the way there from `from` as is allowed.
  Pose within(const Pose& from, const Pose& to) const;
};

}  // namespace stadion
