#pragma once
/// Values as scripts write them.

#include "engine/maths/maths.h"

#include <string>

namespace stadion::assets {

/// Without trailing zeros.
std::string number(double v, int decimals);
std::string list(const Vec3& v, int decimals);

/// About X, then Y, then Z, in degrees.
Vec3 angles(const Quat& q);
/// As attributes: position and orientation.
std::string placed(const Pose& pose);

}  // namespace stadion::assets
