#pragma once
/// What the program says of all its commands and options: man page, table for docs/options.md, shell
/// completion.
///
/// `stadion manual man` prints the man page, `manual options` the page of all options, also those of the
/// other programs (command_programs.h); `manual uses` prints a line for each option of each command, with
/// tabs between: name, command, text, and whether help shows it.
/// `stadion complete WORD...` prints how the last word may go on, a line each, or ":files" or ":folders".

#include <optional>
#include <span>
#include <string>

namespace CLI {
class App;
}

namespace stadion {

/// What the exit status means, for help and man pages.
inline constexpr const char* kExitStatusText =
    "0 ok, 1 a check or comparison failed, 2 bad usage or bad input, 3 internal fault,\n"
    "4 in a cluster: the leader has other files, 5 with --guard: a stage wrote what it may only read,\n"
    "130 or 143 stopped by SIGINT or SIGTERM, 141 the reader of standard output went away.";

/// Nothing if the words after the program's name ask for none of these. Throws std::runtime_error if a
/// program whose options belong there cannot be started.
std::optional<std::string> referenceAnswer(const CLI::App& program, std::span<const std::string> words);

}  // namespace stadion
