#pragma once
/// The last frames that a live show keeps in a file, so that it can be said afterwards why some were late.

#include "cli/run_options.h"
#include "profiling/black_box.h"

namespace stadion {

/// `walls` are the names of all that are drawn. Where the options name no file it is a temporary one.
BlackBoxOptions lastFramesOf(const RunOptions& options, const Player& player, std::vector<std::string> walls);

/// Whether the file that the options name, if they do, can be such a file; the findings say why not.
bool lastFramesCanBeKept(const RunOptions& options, Diagnostics& findings);

/// How many frames were late, why, and where the last ones are; empty if none was.
std::string lateFramesText(const BlackBox& box);

}  // namespace stadion
