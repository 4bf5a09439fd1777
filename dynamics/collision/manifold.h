#pragma once
/// The points at which two shapes touch or nearly touch, for the contact solver.

#include "dynamics/collision/touch.h"

#include <cstdint>
#include <vector>

namespace stadion {

constexpr double kTouching = 1e-4;  ///< pairs closer than this are in contact [m]
constexpr double kDeepBall = 0.2;   ///< share of a ball's radius that it overlaps only when put there

/// The side that the corner of a contact point belongs to. The point turns with that side, the normal with
/// the other.
enum class Carrier : std::uint8_t { None, A, B };

/// How the carrier is round where it touches: it rolls over the point, which stays below its axis.
struct Rounding {
  double radius = 0;         ///< 0: a corner, which turns with the carrier [m]
  Vec3 axis = Vec3::Zero();  ///< axis of a rod or disc, unit, in World; zero: round all over

  /// From the centre of the round part to the point, for the outward direction `down` and a turned axis.
  Vec3 offset(const Vec3& down, const Vec3& turnedAxis) const {
    return radius * (axis.isZero(0) ? down : Vec3((down - turnedAxis * turnedAxis.dot(down)).normalized()));
  }
};

struct ManifoldPoint {
  Gap gap;                ///< normal from b to a
  std::uint32_t key = 0;  ///< number of the feature; equal from step to step
  Carrier carrier = Carrier::None;
  Rounding rounding = {};
};

/// Points of a and b closer than `margin`, at most 16 a pair, in a fixed order.
void manifold(const Side& a, const Side& b, double tau, double margin, std::vector<ManifoldPoint>& points);

}  // namespace stadion
