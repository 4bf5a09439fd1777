#pragma once
/// Counts of callgrind, by the labels with which the program had them written.
///
/// Only instructions of our own program count. Those of the rasteriser, of code generated at run time, and of
/// the system's libraries depend on the processor and on chance.
///
/// Source   Valgrind's manual, "Callgrind format specification".
/// Threads  free functions, any thread.
/// Errors   a file of another format gives nothing.

#include <cstdint>
#include <map>
#include <string>
#include <string_view>

namespace stadion::regression {

/// Returns the command line of the measured program, its words separated by blanks; empty if the file has
/// none.
std::string_view commandOf(std::string_view callgrindFile);

/// Returns instructions by label, for functions in the object file with this real path.
std::map<std::string, double> instructionsByLabel(std::string_view callgrindFile, std::string_view object);

}  // namespace stadion::regression
