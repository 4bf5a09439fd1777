#pragma once
/// What `stadion view` can be asked for.

#include "show/display/show_windows.h"
#include "show/settings/run_options.h"

#include <string>

namespace stadion {

struct ViewOptions {
  RunOptions run;  ///< script, walls, rate, input, records
  std::string windows = "one", stereo = "mono", window = "1200x800", shots = "screenshots", provider = "auto";
  bool hud = false;

  WindowStereo windowStereo = WindowStereo::Mono;  ///< from `stereo`
  std::uint32_t width = 0, height = 0;             ///< from `window`

  /// Expects that this object stays where it is until the command line has been read.
  void addTo(CLI::App& command);
  /// Completes what depends on other options. Says what is wrong.
  bool settle(Diagnostics& findings);
};

/// Keys and mouse, one line each: what --help and the window's own help say.
std::vector<std::string> viewKeys();

}  // namespace stadion
