#include "pipeline/cpu_draw/mesh/list_meshes.h"

namespace stadion {

std::shared_ptr<const CpuMesh> ListMeshes::find(const DrawItem& item) const {
  std::shared_ptr<const CpuMesh> rest = meshes_.find(item.mesh);
  if (!rest || item.figure == 0 || item.figure > list_.figures.size()) return rest;
  const Mesh* mesh = meshes_.source(item.mesh);
  if (!mesh || !mesh->skeleton) return rest;
  return poses_.find(*mesh, rest, list_.figures[item.figure - 1]);
}

std::shared_ptr<const MeshPaint> ListMeshes::paintOf(const DrawItem& item) const {
  if (item.paint == 0 || item.paint > list_.paints.size()) return nullptr;
  const std::shared_ptr<const CpuMesh> bare = meshes_.find(item.mesh);
  const Mesh* mesh = meshes_.source(item.mesh);
  return bare && mesh ? paints_.find(*mesh, bare, list_.paints[item.paint - 1]) : nullptr;
}

}  // namespace stadion
