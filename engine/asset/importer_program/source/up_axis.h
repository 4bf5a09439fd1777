#pragma once
/// Turns coordinates to +Z up.

#include "engine/asset/format.h"
#include "engine/maths/maths.h"

namespace stadion::importer {

/// Maps coordinates with this axis up to +Z up (see format.h).
inline Mat3 toZUp(UpAxis up) {
  Mat3 turn = Mat3::Identity();
  if (up == UpAxis::Y) turn << 1, 0, 0, 0, 0, -1, 0, 1, 0;
  if (up == UpAxis::X) turn << 0, -1, 0, 0, 0, -1, 1, 0, 0;
  return turn;
}

}  // namespace stadion::importer
