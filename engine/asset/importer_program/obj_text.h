#pragma once
/// The text of an OBJ file, checked and mended before assimp reads it.
///
/// assimp overlooks numbers that begin with a point (`v .5 0 1`) and names no place in its errors.

#include <cstdint>
#include <optional>
#include <vector>

namespace stadion::importer {

/// Returns the text with its numbers as assimp reads them; nothing if the text needs no change.
/// Throws Refusal, with line and column, if a vertex, a texture coordinate, a normal or a face is wrong.
std::optional<std::vector<std::uint8_t>> mendedObj(const std::vector<std::uint8_t>& file);

}  // namespace stadion::importer
