#pragma once
/// The options of `stadion view`.

#include "cli/options/renderer_options.h"
#include "cli/options/run_options.h"
#include "show/view/view_settings.h"

#include <string>

namespace stadion {

struct ViewOptions {
  RunOptions run;  ///< script, walls, rate, input, records
  std::string windows = "one", stereo = "off", window = "1200x800";
  RendererOptions renderer;
  ViewSettings settings{};

  /// Expects that this object stays where it is until the command line has been read.
  void addTo(CLI::App& command);
  /// Completes the settings. False, with the reason in the findings, if an option is wrong.
  bool complete(Diagnostics& findings);
};

}  // namespace stadion
