#pragma once
/// PNG, JPEG and WebP pictures to 8-bit RGBA.

#include "engine/asset/mesh_file.h"

#include <span>
#include <string>

namespace stadion::importer {

/// Decodes by content, whatever the name says. Returns false and sets `why` if the format is another one, if
/// the picture is broken, or if it is beyond the limits. Reduces `budget`, the pixel bytes still allowed, by
/// the bytes used.
bool decodePicture(std::span<const std::uint8_t> bytes, const MeshLimits& limits, std::uint64_t& budget,
                   Texture& out, std::string& why);

}  // namespace stadion::importer
