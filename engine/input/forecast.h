#pragma once
/// Where a tracked head will be when its picture is seen: it goes on as it goes, evenly, within limits.
///
/// A head hardly changes its speed within a few hundredths of a second, so that constant velocity and
/// constant angular velocity are right to first order; what they are off by grows with the square of the
/// time. Two things keep it from doing harm. Nobody moves faster than the limits, so whatever says so is
/// noise. And what trembles is not moving: far below the speed of rest nothing is carried on.
///
/// Frames   all in the pose's outer frame.
/// Units    metres, radians, seconds.
/// Threads  pure functions. The same on every machine.

#include "engine/maths/maths.h"

namespace stadion {

struct ForecastLimits {
  double longest = 0.1;            ///< [s]
  double speed = 3, turning = 12;  ///< at most [m/s], [rad/s]
  double restSpeed = 0.05;         ///< at which half of it counts [m/s]
  double restTurning = 0.08;       ///< likewise [rad/s]
};

/// How much older than its measurement a smoothed pose is [s].
struct SmoothingLag {
  double way = 0, turn = 0;
};

/// X after so many seconds, moving with `velocity` and turning with `rotation`. What it lags behind is caught
/// up with.
Pose forecast(const Pose& X, const Vec3& velocity, const Vec3& rotation, double seconds,
              const SmoothingLag& lag = {}, const ForecastLimits& limits = {});

}  // namespace stadion
