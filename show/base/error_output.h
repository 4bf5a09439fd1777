#pragma once
/// The reason of a failure, from what a program wrote to its standard error.

#include <string>

namespace stadion {

/// Whether a line is a finding of this severity: "show.evs:3:1: error: ...".
bool isFinding(const std::string& line, const char* severity);

/// Returns the first error; else the last line that begins with "stadion: "; else the last line. Lines
/// that valgrind or the parser of command lines adds are no reasons. Empty if there is none.
std::string reasonIn(const std::string& said);

}  // namespace stadion
