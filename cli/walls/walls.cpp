/// `stadion walls FILE`: lints a wall file and draws its floor plan, or its test pattern.

#include "cli/commands.h"
#include "cli/exit_code.h"
#include "cli/options/number_option.h"
#include "cli/terminal.h"
#include "cli/walls/wall_pattern.h"
#include "engine/base/installed_files.h"
#include "engine/plain_text/number_text.h"
#include "engine/display/wall_lint.h"
#include "show/base/stop_signal.h"
#include "show/player/player.h"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>
#include <tuple>

namespace stadion {
namespace {

struct WallsOptions {
  std::string file, out, stereo = "mono", size = "800x800";
  bool pattern = false;
  PatternOptions shown;  ///< from the others

  void addTo(CLI::App& command) {
    command.add_option("FILE", file, "cave4, cave6, powerwall, desktop, or a wall file of your own")
        ->required();
    command.add_flag(
        "--pattern", pattern,
        "show the test pattern on the outputs that the file names, until Escape or Ctrl-C: border, "
        "metres, wall's name, L or R, and a cube of 1 m in the middle of the room");
    command.add_option("--out", out, "with --pattern: write it to WALL-EYE.png in this folder instead");
    command.add_option("--stereo", stereo, "with --pattern: how an output shows both eyes")
        ->check(CLI::IsMember(windowStereoNames()))
        ->capture_default_str();
    command
        .add_option("--size", size, "WIDTHxHEIGHT of the pattern where neither output nor pixels are stated")
        ->capture_default_str();
  }

  bool settle(Diagnostics& findings) {
    const auto sides = parseSize(size);
    if (!sides || sides->first < 16 || sides->second < 16 || sides->first > 16384 || sides->second > 16384)
      findings.error({}, "--size: \"" + size +
                             "\" is not WIDTHxHEIGHT in pixels from 16x16 to 16384x16384, "
                             "such as 800x800");
    else
      std::tie(shown.width, shown.height) = *sides;
    if (!out.empty() && !pattern) findings.error({}, "--out needs --pattern: the floor plan is printed");
    shown.out = out;
    shown.windowStereo = *windowStereo(stereo);
    return !findings.hasErrors();
  }
};

int lookAtWalls(WallsOptions o) {
  Diagnostics findings;
  const bool settled = o.settle(findings);
  const auto walls = settled ? loadWalls(o.file, shareFolder() + "/walls", findings) : std::nullopt;
  tell(findings);
  if (!walls) return kBadInput;
  if (o.pattern) return showPattern(*walls, o.shown, catchStopSignals());
  std::printf("%s", floorPlan(*walls).c_str());
  return kOk;
}

}  // namespace

void addWallsCommand(CLI::App& app, int& code) {
  auto o = std::make_shared<WallsOptions>();
  CLI::App* command =
      app.add_subcommand("walls", "Check a wall file and print its floor plan, or show its test pattern");
  o->addTo(*command);
  command->callback([o, &code] { code = lookAtWalls(*o); });
}

}  // namespace stadion
