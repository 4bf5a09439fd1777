#pragma once
/// The point of a solid's surface that is nearest to a given point, in closed form: what a ball needs.

#include "dynamics/shapes/shape.h"

namespace stadion {

struct NearestSurface {
  double distance = 0;                                ///< negative inside [m]
  Vec3 point = Vec3::Zero(), normal = Vec3::UnitZ();  ///< in N; the normal points outwards
  bool face = false;                                  ///< on a flat face
};

NearestSurface nearestSurface(const CapsuleShape& s, const Vec3& x);
NearestSurface nearestSurface(const CylinderShape& s, const Vec3& x);
NearestSurface nearestSurface(const ConvexShape& s, const Vec3& x);

}  // namespace stadion
