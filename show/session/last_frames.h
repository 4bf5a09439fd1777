#pragma once
/// The last frames that a show keeps in a file while it is played, so that it can be said afterwards why some
/// were late, or what was going on when the program died.

#include "profiling/record/black_box.h"
#include "show/settings/run_options.h"

namespace stadion {

/// In a file of the user's folder for them (BlackBoxFolder), of frames that nobody waits for.
BlackBoxOptions unaskedLastFrames(std::vector<std::string> walls);
/// `walls` are the names of all that are drawn. Where the options name no file it is one of
/// that folder.
BlackBoxOptions lastFramesOf(const RunOptions& options, const Player& player, std::vector<std::string> walls);

/// Whether the file that the options name, if they do, can be such a file; the findings say why not.
bool lastFramesCanBeKept(const RunOptions& options, Diagnostics& findings);

/// How many frames were late, why, and where the last ones are; empty if none was and the run did not fail.
std::string lateFramesText(const BlackBox& box);

}  // namespace stadion
