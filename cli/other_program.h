#pragma once
/// Goes on as another program, if that has the command (cli/options/command_programs.h).

#include <string_view>

namespace CLI {
class App;
}

namespace stadion {

struct CommandElsewhere;

/// The command that the words call, or ask how it may go on. Nothing if it is in this program.
const CommandElsewhere* commandElsewhere(int argc, char** argv);

/// Starts its program with the same words. Returns an exit status only if that fails, and says why.
int startProgramOf(const CommandElsewhere& command, char** argv);

/// For the list of subcommands.
void describeElsewhere(CLI::App& app, std::string_view command);

}  // namespace stadion
