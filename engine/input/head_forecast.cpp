#include "engine/input/head_forecast.h"

#include "engine/maths/functions.h"

#include <algorithm>
#include <cmath>

namespace stadion {
namespace {

/// Limits a velocity: little of one below `rest` counts, and nothing above `most`.
Vec3 believed(const Vec3& v, double rest, double most) {
  const double squared = v.squaredNorm();
  if (!(squared > 0)) return Vec3::Zero();
  const double share = squared / (squared + rest * rest);
  return std::min(share, most / std::sqrt(squared)) * v;
}

}  // namespace

Pose forecast(const Pose& X, const Vec3& velocity, const Vec3& rotation, double seconds,
              const SmoothingLag& lag, const ForecastLimits& limits) {
  const double t = std::clamp(seconds, 0.0, limits.longest);
  if (!(t > 0)) return X;
  const Vec3 v = believed(velocity, limits.restSpeed, limits.speed);
  const Vec3 w = believed(rotation, limits.restTurning, limits.turning);
  return {X.p + (t + lag.way) * v, (det::expRotation((t + lag.turn) * w) * X.q).normalized()};
}

}  // namespace stadion
