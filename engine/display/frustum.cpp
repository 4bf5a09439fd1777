#include "engine/display/frustum.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace stadion {
namespace {

struct SeenEye {
  Vec3 p_S;  ///< in the wall's screen coordinates, in front of it [m]
  bool clamped = false;
};

SeenEye inFrontOf(const WallBasis& b, const Affine& X_SR, const Vec3& eye_R) {
  if (!eye_R.allFinite()) return {{0.5 * b.width, 0.5 * b.height, 1}, true};
  Vec3 p = X_SR * eye_R;
  const bool clamped = p.z() < kMinEyeDistance;
  if (clamped) p.z() = kMinEyeDistance;
  return {p, clamped};
}

/// Where along one axis of the wall, and how far from it, eyes may be [m].
struct Reach {
  double lo, hi;
  double zLo, zHi;
};

/// The tangent of the flattest line of sight through 0 that an eye in the reach can have.
double steepest(const Reach& r) {
  return r.hi / (r.hi > 0 ? r.zLo : r.zHi);
}

/// The plane through the edge at 0, normal towards +x: it is turned until no eye sees past it behind the
/// wall, then moved out until all eyes lie inside as well. Returns (normal x, normal z, offset).
Vec3 sidePlane(std::span<const Reach> reaches) {
  double slope = -1e300;
  for (const Reach& r : reaches) slope = std::max(slope, steepest(r));
  double nearest = 1e300;
  for (const Reach& r : reaches) nearest = std::min(nearest, r.lo - slope * (slope > 0 ? r.zHi : r.zLo));
  const double length = std::sqrt(1 + slope * slope);
  return Vec3(1, -slope, std::max(0.0, -nearest)) / length;
}

constexpr std::size_t kMaxEyes = 8;

struct Reaches {
  std::array<Reach, kMaxEyes> reach;
  std::size_t count = 0;
  std::span<const Reach> all() const { return {reach.data(), count}; }
};

/// Reaches along `axis` as seen from the edge at `edge`, mirrored if the wall lies on its negative side.
Reaches reachesFrom(std::span<const Vec3> eyes_S, int axis, double edge, double sign, double margin) {
  Reaches out;
  for (const Vec3& eye : eyes_S) {
    const double x = sign * (eye[axis] - edge);
    out.reach[out.count++] = {x - margin, x + margin, std::max(eye.z() - margin, kMinEyeDistance),
                              eye.z() + margin};
  }
  return out;
}

Plane planeInRig(const Affine& X_SR, const Vec3& normal_S, double offset) {
  const Vec3 normal = X_SR.linear().transpose() * normal_S;
  return {normal, offset + normal_S.dot(X_SR.translation())};
}

}  // namespace

EyeFrustum eyeFrustum(const Wall& wall, const Vec3& eye_R, const DepthRange& depth) {
  assert(depth.near > 0 && depth.far > depth.near);
  const WallBasis b = basis(wall);
  const Affine X_SR = rigToWall(wall);
  const SeenEye seen = inFrontOf(b, X_SR, eye_R);
  const Vec3& p = seen.p_S;
  const double scale = depth.near / p.z();
  EyeFrustum f;
  f.eye = seen.clamped ? Vec3(X_SR.linear().transpose() * (p - X_SR.translation())) : eye_R;
  f.X_ER.linear() = X_SR.linear();
  f.X_ER.translation() = -(X_SR.linear() * f.eye);
  f.left = -p.x() * scale;
  f.right = (b.width - p.x()) * scale;
  f.bottom = -p.y() * scale;
  f.top = (b.height - p.y()) * scale;
  f.depth = depth;
  f.clamped = seen.clamped;
  return f;
}

Mat4 projectionMatrix(const EyeFrustum& f) {
  const double width = f.right - f.left, height = f.top - f.bottom, length = f.depth.far - f.depth.near;
  Mat4 m = Mat4::Zero();
  m(0, 0) = 2 * f.depth.near / width;
  m(0, 2) = (f.right + f.left) / width;
  m(1, 1) = 2 * f.depth.near / height;
  m(1, 2) = (f.top + f.bottom) / height;
  m(2, 2) = f.depth.near / length;
  m(2, 3) = f.depth.far * f.depth.near / length;
  m(3, 2) = -1;
  return m;
}

Mat4 viewMatrix(const EyeFrustum& f, const Pose& X_WR, const Vec3& origin) {
  const Mat3 R_RW = X_WR.q.conjugate().toRotationMatrix();
  const Vec3 rig = X_WR.p - origin;  // first, so that large coordinates cancel before they are rotated
  Mat4 m = Mat4::Identity();
  m.topLeftCorner<3, 3>() = f.X_ER.linear() * R_RW;
  m.topRightCorner<3, 1>() = f.X_ER.translation() - m.topLeftCorner<3, 3>() * rig;
  return m;
}

bool ConvexVolume::contains(const Vec3& p) const {
  return std::ranges::all_of(all(), [&](const Plane& plane) { return plane.distance(p) >= 0; });
}

bool ConvexVolume::mayTouch(const Sphere& sphere) const {
  if (sphere.radius < 0) return false;
  return std::ranges::all_of(
      all(), [&](const Plane& plane) { return plane.distance(sphere.centre) >= -sphere.radius; });
}

bool ConvexVolume::mayTouch(const Aabb& box) const {
  if (box.empty()) return false;
  const Vec3 centre = box.centre(), half = 0.5 * (box.hi - box.lo);
  return std::ranges::all_of(all(), [&](const Plane& plane) {
    return plane.distance(centre) >= -plane.normal.cwiseAbs().dot(half);
  });
}

ConvexVolume ConvexVolume::transformed(const Pose& X_AB, const Vec3& origin) const {
  ConvexVolume out = *this;
  const Vec3 shift = X_AB.p - origin;
  for (Plane& plane : std::span(out.planes.data(), out.count)) {
    plane.normal = X_AB.q * plane.normal;
    plane.offset -= plane.normal.dot(shift);
  }
  return out;
}

ConvexVolume unionFrustum(const Wall& wall, std::span<const Vec3> eyes_R, const DepthRange& depth,
                          double margin) {
  assert(!eyes_R.empty() && eyes_R.size() <= kMaxEyes && margin >= 0);
  const WallBasis b = basis(wall);
  const Affine X_SR = rigToWall(wall);
  std::array<Vec3, kMaxEyes> seen;
  double farthest = 0, nearest = 1e300;
  for (std::size_t i = 0; i < eyes_R.size(); ++i) {
    seen[i] = inFrontOf(b, X_SR, eyes_R[i]).p_S;
    farthest = std::max(farthest, seen[i].z() + margin);
    nearest = std::min(nearest, std::max(seen[i].z() - margin, kMinEyeDistance));
  }
  const std::span<const Vec3> eyes(seen.data(), eyes_R.size());

  ConvexVolume volume;
  const auto side = [&](int axis, double edge, double sign) {
    const Vec3 plane = sidePlane(reachesFrom(eyes, axis, edge, sign, margin).all());
    Vec3 normal(0, 0, plane.y());
    normal[axis] = sign * plane.x();
    volume.planes[volume.count++] = planeInRig(X_SR, normal, plane.z() - normal[axis] * edge);
  };
  side(0, 0, 1);
  side(0, b.width, -1);
  side(1, 0, 1);
  side(1, b.height, -1);
  volume.planes[volume.count++] = planeInRig(X_SR, {0, 0, -1}, farthest - depth.near);
  volume.planes[volume.count++] = planeInRig(X_SR, {0, 0, 1}, depth.far - nearest);
  return volume;
}

}  // namespace stadion
