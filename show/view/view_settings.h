#pragma once
/// How a show is viewed in windows.

#include "show/display/show_windows.h"
#include "show/session/session_settings.h"

#include <optional>
#include <string>
#include <vector>

namespace stadion {

struct ViewSettings {
  SessionSettings session{};  ///< script, walls, rate, input, records
  bool oneWindow = true;      ///< a window with the room unfolded; else a window for each wall
  WindowStereo stereo = WindowStereo::Mono;
  std::uint32_t width = 1200, height = 800;  ///< size of the window at the start
  std::string shots = "screenshots";         ///< folder for screenshots
  bool hud = false;                          ///< the frame budget is shown from the start
  std::string model;                         ///< the model that the script shows alone; empty: a show

  /// The file that the user has named.
  const std::string& file() const { return model.empty() ? session.show.script : model; }
};

/// Keys and mouse, one line each.
std::vector<std::string> viewKeys();

}  // namespace stadion
