#pragma once
/// The rooms that `stadion calibrate` measures, each setting in a process of its own, again and again until
/// the time is over.
///
/// Threads  one thread; the machine should have nothing else to do.

#include "pipeline/platform/calibration.h"
#include "pipeline/shader/look.h"

#include "engine/base/diagnostic.h"

#include <atomic>
#include <functional>
#include <string>
#include <vector>

namespace stadion {

struct RoomRequest {
  std::vector<std::string> walls;  ///< wall files
  std::string size;
  Look look = Look::Full;
  double seconds = 50;  ///< for all of them
};

struct RoomToMeasure {
  std::string walls;  ///< the wall file
  std::string size;
  MeasuredRoom room{};  ///< without settings
  double seconds = 0;
};

struct RoomMeasurement {
  MeasuredRoom room;
  std::string rasteriser;
};

/// Rooms of more walls have more of the time.
std::vector<RoomToMeasure> roomsToMeasure(const RoomRequest& wanted, Diagnostics& findings);

/// Takes not much longer than its seconds, even if not everything could be tried. The show lies in `folder`.
/// Ends early once `stop` is true.
/// `progress` receives text about each setting, piece by piece, with its line breaks.
Result<RoomMeasurement> measureRoom(const RoomToMeasure& room, const std::string& folder,
                                    const std::atomic<bool>& stop,
                                    const std::function<void(const std::string&)>& progress);

/// "process:2:pinned", for the process that measures it.
std::string wordOf(const DrawSetting& setting);
std::optional<DrawSetting> settingOf(const std::string& word);

}  // namespace stadion
