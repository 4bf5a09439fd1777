#pragma once
/// PNG, JPEG and WebP pictures to 8-bit RGBA.

#include "engine/asset/mesh_file.h"

#include <span>
#include <string>

namespace stadion::importer {

/// Decodes by content, whatever the name says. False with `why` for another format, a broken picture or one
/// beyond the limits. `budget` is the number of pixel bytes still allowed; what is used is taken off.
bool decodePicture(std::span<const std::uint8_t> bytes, const MeshLimits& limits, std::uint64_t& budget,
                   Texture& out, std::string& why);

}  // namespace stadion::importer
