#pragma once
/// What a simulation found out about a touch, for nodes that judge it: the exact place and time, not the
/// frame's.

#include "engine/base/time_signature.h"
#include "engine/core/message.h"
#include "engine/maths/maths.h"

namespace stadion {

/// A pair of objects that was apart has touched; or, with `ended`, a body has come to rest, sticks or has
/// been taken out of the simulation: it goes nowhere any more by itself.
struct Impact {
  NodeRef body, other;          ///< no other, if ended
  Vec3 point_W = Vec3::Zero();  ///< where [m]
  Nanoseconds when = 0;
  bool ended = false;
};

}  // namespace stadion
