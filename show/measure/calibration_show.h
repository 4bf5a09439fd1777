#pragma once
/// The show that `stadion calibrate` measures with: a grove of stones all around the visitor, so that every
/// wall of a room has about as much to draw; some of them sway, the sun throws shadows.
///
/// Threads  plain functions.

#include <string>

namespace stadion {

/// Returns the script that writeCalibrationShow() leaves in the folder.
std::string calibrationScript(const std::string& folder);

/// Writes script and model to the folder. Returns why it could not, or nothing.
std::string writeCalibrationShow(const std::string& folder);

}  // namespace stadion
