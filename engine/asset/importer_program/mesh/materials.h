#pragma once
/// The materials and pictures of a source scene as those of a mesh.

#include "engine/asset/importer_program/source/source_scene.h"
#include "engine/asset/mesh_file.h"

#include <string>
#include <vector>

namespace stadion::importer {

/// Where pictures may come from and how large they may be.
struct PictureSource {
  int root;                 ///< the asset root, an open folder
  std::string folder;       ///< the model's own folder below it, "" or ending in '/'
  std::uint64_t fileBytes;  ///< [bytes] largest file
  MeshLimits limits;
};

/// Fills mesh.materials (one for each of the scene's) and mesh.textures. A picture that cannot be read is left
/// out and named in `inventory`. `alphaOfVertices`: by material, whether vertices with it have colours with
/// an alpha below 1.
void readMaterials(const SourceScene& scene, const PictureSource& pictures,
                   const std::vector<bool>& alphaOfVertices, Mesh& mesh, ModelInventory& inventory);

}  // namespace stadion::importer
