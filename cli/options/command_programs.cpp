#include "cli/options/command_programs.h"

#include <CLI/CLI.hpp>
#include <string>

namespace stadion {

CLI::App* addListedCommand(CLI::App& app, std::string_view command) {
  const CommandElsewhere& c = *findElsewhere(command);
  return app.add_subcommand(std::string(c.command), std::string(c.text));
}

}  // namespace stadion
