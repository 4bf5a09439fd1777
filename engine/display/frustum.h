#pragma once
/// Off-axis perspective for a wall and an eye, and what both eyes together can see.
///
/// The eye's axes are the wall's: it looks straight at the wall's plane, wherever the head turns, and the
/// frustum is skewed so that its edges run through the wall's corners. With the eye at (x, y, z) in the
/// wall's screen coordinates, z > 0, and the near plane at distance n, the window on the near plane is
///     left = -x n/z    right = (width - x) n/z    bottom = -y n/z    top = (height - y) n/z
/// (similar triangles; the generalised perspective projection of Kooima, "Generalized Perspective
/// Projection").
///
/// Frames   R is the rig, S the wall's screen, E the eye (axes of S, looks along -Z). X_WR places the rig in
///          World.
/// Units    metres.
/// Threads  pure functions.
/// Errors   an eye on, behind or nearer than kMinEyeDistance to the wall's plane is moved out along the
///          wall's normal to that distance, and the frustum is marked `clamped`. An eye that is not finite is
///          put 1 m in front of the middle of the wall. No result is ever infinite or NaN.

#include "engine/display/wall.h"

#include <array>
#include <cstdint>
#include <span>

namespace stadion {

constexpr double kMinEyeDistance = 0.05;  ///< [m]

/// How near and how far is drawn, from the eye [m]. Expects 0 < near < far.
struct DepthRange {
  double near = 0.1;
  double far = 1000;
};

struct EyeFrustum {
  Vec3 eye = Vec3::Zero();  ///< in R, after clamping [m]
  Affine X_ER = Affine::Identity();
  double left = 0, right = 0, bottom = 0, top = 0;  ///< the window on the near plane [m]
  DepthRange depth;
  bool clamped = false;  ///< the eye was too near the wall's plane or behind it
};

EyeFrustum eyeFrustum(const Wall& wall, const Vec3& eye_R, const DepthRange& depth);

/// Eye to clip coordinates, z in [0, w]: w at the near plane, 0 at the far one. In single precision, depths
/// are then about as exact in proportion to the distance wherever a surface is.
Mat4 projectionMatrix(const EyeFrustum& frustum);

/// World axes relative to `origin` (in World), to eye coordinates. Far from World's origin, an `origin` near
/// the viewer keeps the result exact enough for single precision.
Mat4 viewMatrix(const EyeFrustum& frustum, const Pose& X_WR, const Vec3& origin);

/// Inside is normal . p + offset >= 0.
struct Plane {
  Vec3 normal = Vec3::UnitZ();  ///< unit
  double offset = 0;            ///< [m]

  double distance(const Vec3& p) const { return normal.dot(p) + offset; }
};

/// The set of points that are inside all of a few planes.
struct ConvexVolume {
  static constexpr std::uint32_t kMaxPlanes = 8;

  std::array<Plane, kMaxPlanes> planes;
  std::uint32_t count = 0;

  std::span<const Plane> all() const { return {planes.data(), count}; }
  bool contains(const Vec3& p) const;
  /// False only if the body is wholly outside one of the planes.
  bool mayTouch(const Sphere& sphere) const;
  bool mayTouch(const Aabb& box) const;
  /// Returns the volume in the coordinates that X_AB maps to, relative to `origin` (in A).
  ConvexVolume transformed(const Pose& X_AB, const Vec3& origin = Vec3::Zero()) const;
};

/// The six planes (left, right, bottom, top, near, far), in R, around everything that any of the eyes can see
/// through the wall, wherever each may move within `margin` metres along each axis of the wall. For one eye
/// and no margin they are that eye's frustum exactly. Eyes are clamped as eyeFrustum does. Expects one to
/// eight eyes.
ConvexVolume unionFrustum(const Wall& wall, std::span<const Vec3> eyes_R, const DepthRange& depth,
                          double margin = 0);

}  // namespace stadion
