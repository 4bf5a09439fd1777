#pragma once
/// OBJ, 3DS, COLLADA, STL, FBX and PLY, read by assimp.

#include "engine/asset/importer_program/source/channel.h"
#include "engine/asset/importer_program/source/source_scene.h"

#include "engine/asset/format.h"

namespace stadion::importer {

/// Reads the model with the loader of its own format and no other. `file` is its content.
/// Throws Refusal if the file is broken or beyond the limits.
SourceScene readWithAssimp(const Request& request, const FormatInfo& format,
                           const std::vector<std::uint8_t>& file);

}  // namespace stadion::importer
