#pragma once
/// The parts of a glTF file, each read into a source scene.

#include "engine/asset/importer_program/gltf/gltf_document.h"

namespace stadion::importer {

/// Reads images, textures and materials. glTF's default material is the last one, for primitives without.
void readGltfMaterials(GltfDocument& document, SourceScene& to);

/// Reads meshes. Expects the materials.
void readGltfMeshes(GltfDocument& document, SourceScene& to);

/// Reads nodes, scenes, cameras and lights. Expects the meshes.
void readGltfNodes(GltfDocument& document, SourceScene& to);

/// Reads skins and clips. Expects the nodes.
void readGltfMotion(GltfDocument& document, SourceScene& to);

/// Returns the value's name, or an empty text.
inline std::string nameOf(const GltfValue& value) {
  return value.text("name");
}

/// Returns the weights of morph targets that a mesh or a node states.
std::vector<float> weightsOf(const GltfValue& from);

}  // namespace stadion::importer
