#pragma once
/// Reads PFM files of shares (u, v): their third number is an error estimate, or no number, and counts for nothing.
///
/// Threads  pure function.
/// Errors   go to the Diagnostics with the file's name.

#include "engine/display/screen_mesh.h"

namespace stadion {

/// Returns the grid as readPointGrid does, with z = 0; nothing after an error.
std::optional<PointGrid> readShareGrid(std::string_view bytes, const std::string& file, Diagnostics& out);

}  // namespace stadion
