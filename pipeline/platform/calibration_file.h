#pragma once
/// The file in which calibrations are remembered: JSON that people can read (docs/formats.md).
///
/// Errors   a file that is damaged, or of another version, is told with its name and, where it is known, its
///          line and column; nothing is half read.
/// Threads  plain functions.

#include "engine/base/diagnostic.h"
#include "pipeline/platform/calibration.h"

#include <string>

namespace stadion {

/// STADION_CALIBRATION, or stadion/calibration.json in the user's configuration folder ($XDG_CONFIG_HOME,
/// else ~/.config). Empty if STADION_CALIBRATION is "none", or where the user has no folder.
std::string calibrationFile();

/// Without machines if the file is not there, or is no file's name.
Result<Calibration> readCalibration(const std::string& file);
/// The folder is made if it is not there. Returns why it could not be written, or nothing.
std::optional<Diagnostic> writeCalibration(const std::string& file, const Calibration& calibration);

std::string toJson(const Calibration& calibration);
/// `file` is its name in messages.
Result<Calibration> calibrationOf(const std::string& json, const std::string& file);

}  // namespace stadion
