#pragma once
/// What the programs `stadion`, `stadion-measure` and `stadion-bench` have in common: streams, signals,
/// errors and exit codes.

#include <functional>
#include <optional>

namespace CLI {
class App;
}

namespace stadion {

/// Adds the subcommands. Each leaves its exit status in `code`. The rasteriser's threads, if the environment
/// gives them.
using AddCommands = std::function<void(CLI::App& app, int& code, std::optional<unsigned> rasteriserThreads)>;

/// The main function. Returns the exit status.
int runProgram(int argc, char** argv, const AddCommands& addCommands);

}  // namespace stadion
