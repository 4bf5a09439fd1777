#pragma once
/// The last frames of a show, kept in a file while it is played. They tell afterwards why frames were late,
/// or what happened before the program crashed.

#include "profiling/record/black_box.h"
#include "show/player/play_settings.h"

namespace stadion {

/// In a file of the user's folder for them (BlackBoxFolder), of frames without a deadline.
BlackBoxOptions unaskedLastFrames(std::vector<std::string> walls);
/// In `file`, or if it is empty in a file of that folder. `walls` are the names of all walls that are drawn.
BlackBoxOptions lastFramesOf(const PlaySettings& play, const std::string& file, const Player& player,
                             std::vector<std::string> walls);

/// Returns true if `file`, if it has a name, can hold last frames. The findings say why not.
bool lastFramesCanBeKept(const std::string& file, Diagnostics& findings);

/// How many frames were late, why, and where the last ones are; empty if none was and the run did not fail.
std::string lateFramesText(const BlackBox& box);

}  // namespace stadion
