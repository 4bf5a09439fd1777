#pragma once
/// `stadion bench` is a program of its own, `stadion-bench`: no show needs it, so the first start does not
/// build it.

namespace CLI {
class App;
}

namespace stadion {

/// Whether the words are `bench ...`, or ask how `bench ...` may go on.
bool isBench(int argc, char** argv);

/// Goes on as `stadion-bench` with the same words. Returns an exit status only if that fails, and says why.
int startBench(char** argv);

/// For the list of subcommands.
void describeBench(CLI::App& app);

}  // namespace stadion
