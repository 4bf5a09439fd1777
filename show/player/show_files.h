#pragma once
/// The files that a show is played from, including those not named on the command line.

#include "show/output/output_names.h"

#include <string>
#include <vector>

namespace stadion {

struct ShowOptions;

/// The log that plays with the script: as `input` (--input) says, else the one beside it; empty: none.
std::string inputLogOf(const std::string& script, const std::string& input);
/// `walls` is a file's path or the name of walls that ship with Stadion, as loadHall takes it.
std::string wallFileOf(const std::string& walls);
/// Script, walls and log, none of which may be written over.
std::vector<NamedFile> filesOf(const ShowOptions& show);

}  // namespace stadion
