#pragma once
/// From the axes and the unit of a file to metres, +Z up.

#include "engine/asset/format.h"
#include "engine/asset/importer_protocol.h"
#include "engine/maths/maths.h"

#include <vector>

struct aiScene;

namespace stadion::importer {

/// Maps what assimp hands out to metres, +Z up. The request's unit and up axis win over the file's.
/// assimp turns 3DS and COLLADA files to +Y up by itself. It leaves FBX files as they are, and states their
/// axes and unit in the scene's metadata.
Affine toShow(const aiScene& scene, const FormatInfo& format, const RequestHead& head,
              const std::vector<std::uint8_t>& file);

}  // namespace stadion::importer
