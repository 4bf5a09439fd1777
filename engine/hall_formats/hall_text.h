#pragma once
/// A hall as text with the files that it names: how a foreign hall becomes a wall file of its own.
///
/// Units    metres. Warps are written with 32-bit numbers, meshes and the text with all digits.
/// Threads  pure functions.
/// Errors   are sentences for the user.

#include "engine/base/diagnostic.h"
#include "engine/display/wall_file.h"

#include <map>
#include <string>

namespace stadion {

struct HallText {
  std::string text;                          ///< of the wall file
  std::map<std::string, std::string> files;  ///< contents, by the names that the text has for them
  std::vector<std::string> lost;             ///< what a wall file cannot say, a sentence each
};

/// Names of files begin with `prefix`. Masks are written in linear light; with `masksElsewhere` only their names
/// are given.
Result<HallText> hallText(const WallFile& hall, const std::string& prefix, bool masksElsewhere = false);

/// Writes a wall file and its files beside it.
std::optional<Diagnostic> writeHallText(const WallFile& hall, const std::string& path, Diagnostics& out);

/// A PFM file of the points, the lowest row first.
std::string pointsAsPfm(const std::vector<Vec3>& points, std::uint32_t columns, std::uint32_t rows);

}  // namespace stadion
