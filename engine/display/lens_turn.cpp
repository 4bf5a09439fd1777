#include "engine/display/lens_turn.h"

#include "engine/maths/functions.h"

namespace stadion {

Quat rotationOf(const LensTurn& turn) {
  const Quat yaw = det::expRotation(Vec3(0, 0, -turn.yaw));
  const Quat pitch = det::expRotation(Vec3(turn.pitch, 0, 0));
  const Quat roll = det::expRotation(Vec3(0, turn.roll, 0));
  return (yaw * pitch * roll).normalized();
}

LensTurn turnTowards(const Vec3& direction) {
  LensTurn turn;
  const double level = direction.head<2>().norm();
  if (level > 1e-9 * direction.norm()) turn.yaw = det::atan2(direction.x(), direction.y());
  turn.pitch = det::atan2(direction.z(), level);
  return turn;
}

LensTurn turnOf(const Quat& q_RP) {
  LensTurn turn = turnTowards(q_RP * Vec3(0, 1, 0));
  // What is left to the right of the unrolled picture is right; the roll takes it down.
  const Quat unrolled = rotationOf(turn);
  const Vec3 right = unrolled.conjugate() * (q_RP * Vec3(1, 0, 0));
  turn.roll = det::atan2(-right.z(), right.x());
  return turn;
}

}  // namespace stadion
