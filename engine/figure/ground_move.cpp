#include "engine/figure/ground_move.h"

#include "engine/maths/functions.h"
#include "engine/maths/pose_track.h"

#include <cmath>

namespace stadion {
namespace {

constexpr double kWholeTurn = 6.283185307179586476925;  // [rad]

}  // namespace

GroundMove GroundMove::operator*(const GroundMove& b) const {
  const auto [s, c] = det::sincos(turn);
  return {x + (c * b.x - s * b.y), y + (s * b.x + c * b.y), turn + b.turn};
}

GroundMove GroundMove::inverse() const {
  const auto [s, c] = det::sincos(turn);
  return {-(c * x + s * y), s * x - c * y, -turn};
}

Pose GroundMove::pose() const {
  const auto [s, c] = det::sincos(0.5 * turn);
  return {Vec3(x, y, 0), Quat(c, 0, 0, s)};
}

GroundMove groundMoveOf(const Affine& X_NB, const Affine& atRest) {
  const Quat turned = poseOf(X_NB).q * poseOf(atRest).q.conjugate();
  GroundMove move;
  if (!turned.coeffs().allFinite()) return move;  // an axis without length
  if (turned.w() * turned.w() + turned.z() * turned.z() > 1e-12)
    move.turn = 2 * det::atan2(turned.z(), turned.w());
  const auto [s, c] = det::sincos(move.turn);
  const Vec3 from = atRest.translation(), to = X_NB.translation();
  move.x = to.x() - (c * from.x() - s * from.y());
  move.y = to.y() - (s * from.x() + c * from.y());
  return move;
}

GroundMove groundMoveBetween(const GroundMove& a, const GroundMove& b) {
  GroundMove move = a.inverse() * b;
  move.turn -= kWholeTurn * std::floor(move.turn / kWholeTurn + 0.5);
  return move;
}

GroundMove groundMovePower(const GroundMove& move, std::int64_t times) {
  GroundMove power, square = times < 0 ? move.inverse() : move;
  for (auto left = static_cast<std::uint64_t>(times < 0 ? -times : times); left != 0; left /= 2) {
    if (left % 2 == 1) power = power * square;
    square = square * square;
  }
  return power;
}

}  // namespace stadion
