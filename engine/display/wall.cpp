#include "engine/display/wall.h"

#include <cassert>

namespace stadion {

std::string pictureName(std::size_t number) {
  return number < kEyes.size() ? eyeName(kEyes[number]) : "view-" + std::to_string(number + 1);
}

WallBasis basis(const Wall& wall) {
  WallBasis b;
  const Vec3 lower = wall.lowerRight - wall.lowerLeft;
  b.width = lower.norm();
  b.right = lower / b.width;
  const Vec3 left = wall.upperLeft - wall.lowerLeft;
  const Vec3 square = left - left.dot(b.right) * b.right;
  b.height = square.norm();
  assert(b.width > 0 && b.height > 0);
  b.up = square / b.height;
  b.normal = b.right.cross(b.up);
  return b;
}

Affine rigToWall(const Wall& wall) {
  const WallBasis b = basis(wall);
  Affine X_SR;
  X_SR.linear() << b.right.transpose(), b.up.transpose(), b.normal.transpose();
  X_SR.translation() = -(X_SR.linear() * wall.lowerLeft);
  return X_SR;
}

Vec3 eyePosition(const Pose& X_RH, Eye eye, double separation) {
  const double half = eye == Eye::Left ? -0.5 * separation : 0.5 * separation;
  return X_RH * Vec3(half, 0, 0);
}

}  // namespace stadion
