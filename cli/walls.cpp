/// `stadion walls FILE`: lints a wall file and draws its floor plan.

#include "cli/commands.h"
#include "cli/exit_code.h"
#include "cli/player.h"
#include "engine/display/wall_lint.h"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>

namespace stadion {

void addWallsCommand(CLI::App& app, int& code) {
  auto file = std::make_shared<std::string>();
  CLI::App* command = app.add_subcommand("walls", "Check a wall file and print its floor plan");
  command->add_option("FILE", *file, "cave4, cave6, powerwall, desktop, or a wall file of your own")
      ->required();
  command->callback([file, &code] {
    Diagnostics findings;
    const auto walls = loadWalls(*file, std::string(STADION_ROOT) + "/walls", findings);
    tell(findings);
    if (walls) std::printf("%s", floorPlan(*walls).c_str());
    code = walls ? kOk : kBadInput;
  });
}

}  // namespace stadion
