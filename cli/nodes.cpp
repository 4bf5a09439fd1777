/// `stadion nodes [TYPE]`: the language reference.

#include "cli/commands.h"
#include "cli/exit_code.h"

#include <CLI/CLI.hpp>

namespace stadion {

void addNodesCommand(CLI::App&, int&) {}

}  // namespace stadion
