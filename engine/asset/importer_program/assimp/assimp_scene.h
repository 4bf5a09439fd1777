#pragma once
/// assimp's scene as a source scene.

#include "engine/asset/format.h"
#include "engine/asset/importer_program/source/source_scene.h"

#include <assimp/scene.h>

namespace stadion::importer {

/// Fills all of `to` but its axes. Expects triangulated meshes whose indices have been checked.
void convert(const aiScene& scene, const FormatInfo& format, SourceScene& to);

/// Fills materials and images only.
void convertMaterials(const aiScene& scene, const FormatInfo& format, SourceScene& to);

/// Fills skins and clips only. Expects the nodes.
void convertMotion(const aiScene& scene, SourceScene& to);

Affine toAffine(const aiMatrix4x4& m);

}  // namespace stadion::importer
