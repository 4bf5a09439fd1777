#pragma once
/// Finds a room in its trackers' coordinates, from a few poses held still.
///
///     middle   a tracker lies on the mark in the middle of the floor
///     ahead    the same tracker lies farther ahead, on the line to the front wall
///     head     a person stands on the mark with the glasses on and looks straight ahead, level
///
/// The first two give origin and yaw, the third the place of the eyes relative to the sensor on the glasses:
///
///     p_SR = middle,   yaw = atan2(-d.x, d.y) of d = ahead - middle,   X_DT = (X_RS X_SD)^-1 X_RT.
///
/// Frames, units  as in rig_file.h; poses are as they were sent.
/// Errors         one sentence; a rig is only returned if all of it makes sense.

#include "engine/input/rig_file.h"

#include <vector>

namespace stadion {

/// A held pose: the mean of measurements, and how far they were apart.
struct HeldPose {
  Pose X_SD;
  double spread = 0;  ///< farthest from the mean [m], as sent
};
/// Expects at least one measurement.
HeldPose meanOf(const std::vector<Pose>& measured);

/// The rig with another origin and yaw.
Result<RigFile> calibrateRoom(RigFile rig, const Pose& middle, const Pose& ahead);
/// Returns the rig with another sensor-to-eyes pose of `tracker`, for a person with eyes at this height [m].
Result<RigFile> calibrateEyes(RigFile rig, const std::string& tracker, const Pose& head, double eyeHeight);

}  // namespace stadion
