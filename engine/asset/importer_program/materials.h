#pragma once
/// assimp's materials and pictures as ours.

#include "engine/asset/format.h"
#include "engine/asset/mesh_file.h"

#include <assimp/scene.h>

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

/// Fills mesh.materials (one for each of the scene's) and mesh.textures. A picture that cannot be had is left
/// out and named in `notes`. `alphaOfVertices`: vertices have colours with an alpha below 1.
void readMaterials(const aiScene& scene, const FormatInfo& format, const PictureSource& pictures,
                   bool alphaOfVertices, Mesh& mesh, std::vector<std::string>& notes);

}  // namespace stadion::importer
