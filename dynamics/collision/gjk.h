#pragma once
/// The distance between two convex cores.
///
/// Method   Gilbert, Johnson, Keerthi, A Fast Procedure for Computing the Distance Between Complex Objects,
///          1988; ends when upper and lower bound of the distance agree to rounding, or nothing improves any
///          more.

#include "dynamics/shapes/convex_core.h"

namespace stadion {

struct CoreDistance {
  bool apart = false;                       ///< false: the cores overlap, or touch within rounding
  double distance = 0;                      ///< [m]
  Vec3 normal = Vec3::UnitZ();              ///< from b to a, unit
  Vec3 a = Vec3::Zero(), b = Vec3::Zero();  ///< nearest points
  int steps = 0;
};

/// `guess`: a direction from b to a to begin with. `accuracy`: relative, of the distance.
CoreDistance coreDistance(const ConvexCore& a, const ConvexCore& b, const Vec3& guess,
                          double accuracy = 1e-15);

}  // namespace stadion
