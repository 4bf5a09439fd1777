#pragma once
/// Loads a hall from a wall file or from a file of another program, by its name and content.
///
///     NAME, .walls             a wall file (wall_file.h)
///     .mpcdi, .mpcdi.xml       MPCDI (mpcdi_reader.h)
///     .json                    SGCT (sgct_reader.h), or nDisplay if it has an object of that name
///     .ndisplay, .cfg          nDisplay (ndisplay_reader.h)
///
/// Threads  any thread.
/// Errors   go to the Diagnostics. What a foreign file has and is not understood is a warning with its place.

#include "engine/display/wall_file.h"

namespace stadion {

/// True if the name ends as those of foreign halls do.
bool isForeignHall(const std::string& path);

/// Reads a foreign file and the files that it names, and places the rectangles of projectors.
std::optional<WallFile> readForeignHall(const std::string& path, Diagnostics& out);

/// Loads a hall of any kind and lints it; `folder` has the walls that ship with Stadion (loadWalls).
std::optional<WallFile> loadHall(const std::string& nameOrPath, const std::string& folder, Diagnostics& out);

/// Writes the hall as the ending of `path` says: .walls, with its files beside it, or .mpcdi. Nothing on success.
std::optional<Diagnostic> writeHall(const WallFile& hall, const std::string& path, Diagnostics& out);

}  // namespace stadion
