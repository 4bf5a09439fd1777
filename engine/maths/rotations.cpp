#include "engine/maths/functions.h"

#include <cmath>

namespace stadion::det {

Quat expRotation(const Vec3& w) {
  const double square = w.squaredNorm();
  double c, s;  // cos(a/2), sin(a/2)/a
  if (square < 1e-3) {
    const double z = 0.25 * square;
    c = 1 - z / 2 * (1 - z / 12 * (1 - z / 30 * (1 - z / 56)));
    s = 0.5 * (1 - z / 6 * (1 - z / 20 * (1 - z / 42 * (1 - z / 72))));
  } else {
    const double a = std::sqrt(square);
    const SinCos h = sincos(0.5 * a);
    c = h.cos;
    s = h.sin / a;
  }
  return {c, s * w.x(), s * w.y(), s * w.z()};
}

Vec3 logRotation(const Quat& q) {
  const double sign = q.w() < 0 ? -1 : 1, n = q.vec().norm();
  if (n < 1e-150) return 2 * sign * q.vec();
  return (sign * 2 * atan2(n, std::fabs(q.w())) / n) * q.vec();
}

Quat slerp(const Quat& a, const Quat& b, double s) {
  if (s <= 0) return a;
  if (s >= 1) return b;
  return (a * expRotation(s * logRotation(a.conjugate() * b))).normalized();
}

Pose interpolate(const Pose& a, const Pose& b, double s) {
  if (s <= 0) return a;
  if (s >= 1) return b;
  return {a.p + s * (b.p - a.p), slerp(a.q, b.q, s)};
}

Quat fromEuler(double roll, double pitch, double yaw) {
  const SinCos r = sincos(0.5 * roll), p = sincos(0.5 * pitch), y = sincos(0.5 * yaw);
  return Quat(y.cos, 0, 0, y.sin) * Quat(p.cos, 0, p.sin, 0) * Quat(r.cos, r.sin, 0, 0);
}

}  // namespace stadion::det
