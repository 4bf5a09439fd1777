#pragma once
/// Some commands are in programs of their own: no show needs them, so the first start does not build them.

#include <array>
#include <string_view>

namespace CLI {
class App;
}

namespace stadion {

/// A command that is not in the program `stadion`.
struct CommandElsewhere {
  std::string_view command, program;
  std::string_view text;  ///< for the list of commands
};

inline constexpr std::array kCommandsElsewhere{
    CommandElsewhere{"bench", "stadion-bench", "Measure, and fail when a limit is missed"},
    CommandElsewhere{"fit", "stadion-measure",
                     "Find the cheapest flight model that follows recorded flights"},
    CommandElsewhere{
        "profile", "stadion-measure",
        "Say what the frames of a show are spent on, node by node; or how exact and how expensive the "
        "models of its bodies are"},
    CommandElsewhere{"plan", "stadion-measure",
                     "Predict frames a second and latency for other machines, walls and modes"},
    CommandElsewhere{"regress", "stadion-measure",
                     "Play a suite of shows and compare hashes, counts and times with a baseline or another "
                     "build"},
    CommandElsewhere{
        "soak", "stadion-measure",
        "Play shows for very many frames, as fast as possible, and look whether anything grows or "
        "changes"},
    CommandElsewhere{"calibrate", "stadion-measure",
                     "Measure how walls are drawn fastest on this machine, and remember it (a minute)"}};

/// Nothing if the program `stadion` has the command itself.
constexpr const CommandElsewhere* findElsewhere(std::string_view command) {
  for (const CommandElsewhere& c : kCommandsElsewhere)
    if (c.command == command) return &c;
  return nullptr;
}

/// Adds a command of the list, with its text.
CLI::App* addListedCommand(CLI::App& app, std::string_view command);

}  // namespace stadion
