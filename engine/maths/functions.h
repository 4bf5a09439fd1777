#pragma once
/// Elementary functions with the same results on every machine.
///
/// The C library chooses variants of these by processor and rounds differently from one to the next, which
/// would let replicas drift apart. Simulated state therefore calls these, and from the C library only sqrt
/// and fabs, which IEEE 754 fixes. Errors below 1 ulp or so on the ranges stated; NaN in, NaN out.

#include "engine/maths/maths.h"

namespace stadion::det {

struct SinCos {
  double sin, cos;
};

SinCos sincos(double x);  ///< [rad], |x| < 1e9 for full accuracy
double sin(double x);
double cos(double x);
double tan(double x);
double atan(double x);
double atan2(double y, double x);
double asin(double x);  ///< clamped to [-1, 1]
double acos(double x);  ///< clamped to [-1, 1]
double exp(double x);
double expm1(double x);  ///< exp(x) - 1 without cancellation
double log(double x);
double pow(double x, double y);  ///< x > 0
double cbrt(double x);

/// Rotation by |w| about w (Rodrigues, as a unit quaternion). w = 0 gives the identity.
Quat expRotation(const Vec3& w);
/// The rotation vector of q, angle in [0, pi].
Vec3 logRotation(const Quat& q);
/// From a to b with constant angular velocity, the short way round; s in [0, 1].
Quat slerp(const Quat& a, const Quat& b, double s);
/// From a to b: straight line and constant angular velocity.
Pose interpolate(const Pose& a, const Pose& b, double s);
/// Rotation about X by roll, then Y by pitch, then Z by yaw (fixed axes), all in radians.
Quat fromEuler(double roll, double pitch, double yaw);

}  // namespace stadion::det
