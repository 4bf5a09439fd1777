#pragma once
/// From the axes of OpenGL programs (+X right, +Y up, +Z back) to those of the rig (+X right, +Y forward, +Z up).

#include "engine/maths/angles.h"
#include "engine/maths/functions.h"

namespace stadion {

inline Vec3 fromGlAxes(const Vec3& v) {
  return {v.x(), -v.z(), v.y()};
}

/// A rotation between two frames that both change their axes so.
inline Quat fromGlAxes(const Quat& q) {
  return {q.w(), q.x(), -q.z(), q.y()};
}

/// Rotation about an axis, 0 = X, by degrees.
inline Quat turnAbout(int axis, double degrees) {
  return det::expRotation(degrees * kDegree * Vec3::Unit(axis));
}

}  // namespace stadion
