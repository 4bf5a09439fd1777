#pragma once
/// One setting of `stadion calibrate`, measured in this process: Mesa reads how many threads it has once.
///
/// Threads  plain function, on the main thread.

#include "engine/base/diagnostic.h"
#include "pipeline/platform/calibration.h"
#include "pipeline/shader/look.h"

#include <string>

namespace stadion {

struct CalibrationRun {
  DrawSetting setting{};
  std::string folder;  ///< folder of the show (writeCalibrationShow)
  std::string walls = "cave4", size = "800x600";
  Look look = Look::Full;
  double seconds = 1;  ///< measured time, after the frames in which programs are compiled
};

struct CalibrationFigures {
  double framesPerSecond = 0;
  double cpuMs = 0;        ///< a frame, of this process and those that draw for it
  std::string rasteriser;  ///< description that the rasteriser gives of itself
};

/// The findings say more about a failure.
Result<CalibrationFigures> measureSetting(const CalibrationRun& run, Diagnostics& findings);

}  // namespace stadion
