#pragma once
/// Frames of MPCDI files, and the rig's.

#include "engine/hall_formats/mpcdi_document.h"

namespace stadion {

/// World coordinates as the standard prefers them (X left, Y up, Z forward) to the rig's axes; its own inverse
/// is rigToMpcdi.
inline Vec3 mpcdiToRig(const Vec3& v) {
  return {-v.x(), v.z(), v.y()};
}
inline Vec3 rigToMpcdi(const Vec3& v) {
  return {-v.x(), v.z(), v.y()};
}

/// World coordinates whose axes the frame explains, to the rig's axes.
inline Vec3 frameToRig(const MpcdiFrame& frame, const Vec3& v) {
  return {v.dot(frame.pitch), v.dot(frame.roll), -v.dot(frame.yaw)};
}

}  // namespace stadion
