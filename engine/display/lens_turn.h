#pragma once
/// How a lens is turned, as people measure it.
///
/// Frames   R is the rig, P the projector (projector.h).
/// Units    radians.
/// Threads  pure functions.

#include "engine/maths/maths.h"

namespace stadion {

struct LensTurn {
  double yaw = 0;    ///< to the right, as an azimuth
  double pitch = 0;  ///< up, from -pi/2 to pi/2
  double roll = 0;   ///< clockwise, seen along the lens
};

/// Returns the rotation P to R.
Quat rotationOf(const LensTurn& turn);

/// Returns the turn that makes the rotation. Straight up or down the yaw is 0.
LensTurn turnOf(const Quat& q_RP);

/// Returns yaw and pitch that look along `direction`, which has any length but 0.
LensTurn turnTowards(const Vec3& direction);

}  // namespace stadion
