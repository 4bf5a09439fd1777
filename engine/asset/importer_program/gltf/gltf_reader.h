#pragma once
/// glTF 2.0 (.gltf, .glb), read by code of our own.
///
/// assimp 5.2.5 drops interpolation modes, samplers and most extensions. tinygltf 2.7.0 refuses accessors and
/// buffers without data of their own, which compressed files have, and reads images beyond their buffer.

#include "engine/asset/importer_program/source/channel.h"
#include "engine/asset/importer_program/source/source_scene.h"

namespace stadion::importer {

/// Reads the model and the files that it names. `file` is its content.
/// Throws Refusal if the file is broken or beyond the limits.
SourceScene readGltf(const Request& request, const std::vector<std::uint8_t>& file);

}  // namespace stadion::importer
