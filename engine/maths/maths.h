#pragma once
/// The linear algebra that every layer shares: Eigen types under the names the field uses.
///
/// Frames   right-handed, +Z up. `X_AB` maps coordinates in B to coordinates in A; `p_AB` is B's origin in A;
///          `v_WB` is body B's velocity in World.
/// Units    metres, seconds, kilograms, radians, newtons.

#include "engine/maths/eigen.h"

namespace stadion {

using Vec2 = Eigen::Vector2d;
using Vec3 = Eigen::Vector3d;
using Vec4 = Eigen::Vector4d;
using Mat3 = Eigen::Matrix3d;
using Mat4 = Eigen::Matrix4d;
using Quat = Eigen::Quaterniond;

/// A rotation followed by a translation: a = q b + p.
struct Pose {
  Vec3 p = Vec3::Zero();      ///< origin of B in A [m]
  Quat q = Quat::Identity();  ///< unit quaternion, B to A

  Vec3 operator*(const Vec3& b) const { return q * b + p; }
  Pose operator*(const Pose& X_BC) const { return {q * X_BC.p + p, (q * X_BC.q).normalized()}; }
  Pose inverse() const { return {-(q.conjugate() * p), q.conjugate()}; }
  bool finite() const { return p.allFinite() && q.coeffs().allFinite(); }
};

/// A general placement (3 x 4): rotation, scale and translation. Column vectors; `X_WN * p_N`.
using Affine = Eigen::Transform<double, 3, Eigen::AffineCompact>;

inline Affine toAffine(const Pose& X_AB) {
  Affine X;
  X.linear() = X_AB.q.toRotationMatrix();
  X.translation() = X_AB.p;
  return X;
}

/// Skew(a) b = a x b (Eq. 2).
inline Mat3 skew(const Vec3& a) {
  Mat3 s;
  s << 0, -a.z(), a.y(), a.z(), 0, -a.x(), -a.y(), a.x(), 0;
  return s;
}

/// Bounding sphere. radius < 0 is empty.
struct Sphere {
  Vec3 centre = Vec3::Zero();  ///< [m]
  double radius = -1;          ///< [m]
};

/// Axis-aligned box. Empty while lo > hi.
struct Aabb {
  Vec3 lo = Vec3::Constant(1e300);
  Vec3 hi = Vec3::Constant(-1e300);

  void include(const Vec3& p) {
    lo = lo.cwiseMin(p);
    hi = hi.cwiseMax(p);
  }
  void include(const Aabb& b) {
    lo = lo.cwiseMin(b.lo);
    hi = hi.cwiseMax(b.hi);
  }
  bool empty() const { return lo.x() > hi.x(); }
  Vec3 centre() const { return 0.5 * (lo + hi); }
  bool overlaps(const Aabb& b) const {
    return (lo.array() <= b.hi.array()).all() && (b.lo.array() <= hi.array()).all();
  }
};

}  // namespace stadion
