#pragma once
/// Predicts where a tracked head will be when its picture is seen, by constant velocity within limits.
///
/// A head hardly changes its speed within a few hundredths of a second. So constant velocity and constant
/// angular velocity are right to first order, and their error grows with the square of the time. Two rules
/// prevent harm. A visitor cannot move faster than the limits, so a higher speed is noise. A head that
/// trembles is at rest: far below the speed of rest nothing is predicted.
///
/// Frames   all in the pose's outer frame.
/// Units    metres, radians, seconds.
/// Threads  pure functions; equal on every machine.
/// Errors   none.

#include "engine/maths/maths.h"

namespace stadion {

struct ForecastLimits {
  double longest = 0.1;            ///< [s]
  double speed = 3, turning = 12;  ///< at most [m/s], [rad/s]
  double restSpeed = 0.05;         ///< at this speed half of it counts [m/s]
  double restTurning = 0.08;       ///< likewise [rad/s]
};

/// By how much a smoothed pose lags behind its measurement [s].
struct SmoothingLag {
  double way = 0, turn = 0;
};

/// The pose X after `seconds`, if it moves with `velocity` and turns with `rotation`. Makes up for its lag.
Pose forecast(const Pose& X, const Vec3& velocity, const Vec3& rotation, double seconds,
              const SmoothingLag& lag = {}, const ForecastLimits& limits = {});

}  // namespace stadion
