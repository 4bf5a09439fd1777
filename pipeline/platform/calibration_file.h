#pragma once
/// The file that stores calibrations: JSON that people can read (docs/formats.md).
///
/// Errors   A damaged file, or one of another version, is reported with its name and, if known, its line and
///          column. Then nothing is read from it.
/// Threads  plain functions.

#include "engine/base/diagnostic.h"
#include "pipeline/platform/calibration.h"

#include <string>

namespace stadion {

/// Returns STADION_CALIBRATION, or stadion/calibration.json in the user's configuration folder
/// ($XDG_CONFIG_HOME, else ~/.config). Empty if STADION_CALIBRATION is "none", or if the user has no folder.
std::string calibrationFile();

/// Returns a calibration without machines if the file does not exist or the name is empty.
Result<Calibration> readCalibration(const std::string& file);
/// Creates the folder if it does not exist. Returns why the file could not be written, or nothing.
std::optional<Diagnostic> writeCalibration(const std::string& file, const Calibration& calibration);

std::string toJson(const Calibration& calibration);
/// `file` is its name in messages.
Result<Calibration> calibrationOf(const std::string& json, const std::string& file);

}  // namespace stadion
