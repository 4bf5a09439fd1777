#pragma once
/// Jumps: moves between two records of a tracker that no hand or foot can make. The device was lost
/// meanwhile, or taken for another. docs/language.md ("A tracker's jump") has the whole rule.
///
/// Threads  pure functions.

#include "engine/base/time_signature.h"
#include "engine/maths/maths.h"

namespace stadion {

constexpr Nanoseconds kLongestJump =
    50'000'000;                    ///< between two records that are farther apart none is seen [ns]
constexpr double kJumpSpeed = 15;  ///< more than this, and so much faster than its neighbours [m/s]

/// `v`: velocity from the record before, `took` later; `neighbour`: velocity of the move before or after,
/// zero if it is not known.
inline bool jumpsBeside(const Vec3& v, const Vec3& neighbour, Nanoseconds took) {
  return took <= kLongestJump && v.norm() > kJumpSpeed && (v - neighbour).norm() > kJumpSpeed;
}

}  // namespace stadion
