#pragma once
/// What callgrind has counted, by the labels under which the program had it written down.
///
/// Only instructions of our own program count: those of the rasteriser, of code it makes at run time, and of
/// the system's libraries depend on the processor and on chance.
///
/// Source   Valgrind's manual, "Callgrind format specification".
/// Threads  free functions, any thread.
/// Errors   a file that is none gives nothing.

#include <cstdint>
#include <map>
#include <string>
#include <string_view>

namespace stadion::regression {

/// The command line of the program that was watched, its words with blanks between them; empty if none is
/// said.
std::string_view commandOf(std::string_view callgrindFile);

/// Instructions by label, of the functions in the object file with this real path.
std::map<std::string, double> instructionsByLabel(std::string_view callgrindFile, std::string_view object);

}  // namespace stadion::regression
