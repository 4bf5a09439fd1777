#include "bench/walls/wall_room.h"

#include <cmath>

namespace stadion::bench {
namespace {

constexpr double kHalf = 1.5;  ///< from the room's middle to each wall [m]

/// glFrustum's matrix.
Mat4 frustum(double left, double right, double bottom, double top, double near, double far) {
  Mat4 m = Mat4::Zero();
  m(0, 0) = 2 * near / (right - left);
  m(0, 2) = (right + left) / (right - left);
  m(1, 1) = 2 * near / (top - bottom);
  m(1, 2) = (top + bottom) / (top - bottom);
  m(2, 2) = -(far + near) / (far - near);
  m(2, 3) = -2 * far * near / (far - near);
  m(3, 2) = -1;
  return m;
}

}  // namespace

const std::array<RoomWall, 6>& roomWalls() {
  constexpr double h = kHalf;
  static const std::array<RoomWall, 6> walls{
      {{"front", raised(-h, -h, -h), raised(h, -h, -h), raised(-h, h, -h)},
       {"left", raised(-h, -h, h), raised(-h, -h, -h), raised(-h, h, h)},
       {"right", raised(h, -h, -h), raised(h, -h, h), raised(h, h, -h)},
       {"floor", raised(-h, -h, h), raised(h, -h, h), raised(-h, -h, -h)},
       {"back", raised(h, -h, h), raised(-h, -h, h), raised(h, h, h)},
       {"ceiling", raised(-h, h, -h), raised(h, h, -h), raised(-h, h, h)}}};
  return walls;
}

double platformHeadingAt(double t) {
  return 0.05 * t;
}

Pose platformAt(double t) {
  return {raised(40 * std::cos(0.1 * t), 0, 40 * std::sin(0.1 * t)),
          Quat(Eigen::AngleAxisd(platformHeadingAt(t), Vec3::UnitZ()))};
}

Vec3 headAt(double t) {
  return raised(0.3 * std::sin(1.3 * t), 0.1 * std::sin(1.7 * t), 0.3 * std::cos(0.9 * t));
}

double headHeadingAt(double t) {
  return 0.5 * std::sin(0.8 * t);
}

WallView wallView(const WallScene& scene, std::size_t wall, int eye, double t) {
  const double heading = headHeadingAt(t), side = (eye ? 0.5 : -0.5) * kWallEyeSeparation;
  const Vec3 e = headAt(t) + side * Vec3(std::cos(heading), std::sin(heading), 0);
  const RoomWall& w = roomWalls()[wall];
  const Vec3 right = (w.lowerRight - w.lowerLeft).normalized(), up = (w.upperLeft - w.lowerLeft).normalized(),
             out = right.cross(up);
  const Vec3 a = w.lowerLeft - e, b = w.lowerRight - e, c = w.upperLeft - e;
  const double k = kWallNear / -a.dot(out);
  Mat4 turn = Mat4::Identity();
  turn.topLeftCorner<3, 3>() << right.transpose(), up.transpose(), out.transpose();
  Mat4 move = Mat4::Identity(), room = Mat4::Identity();
  move.topRightCorner<3, 1>() = -e;
  const Affine inverse = toAffine(platformAt(t).inverse());
  room.topLeftCorner<3, 4>() = inverse.matrix();
  return {frustum(right.dot(a) * k, right.dot(b) * k, up.dot(a) * k, up.dot(c) * k, kWallNear, scene.far()),
          turn * move * room};
}

}  // namespace stadion::bench
