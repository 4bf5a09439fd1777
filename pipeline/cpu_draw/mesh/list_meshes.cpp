#include "pipeline/cpu_draw/mesh/list_meshes.h"

namespace stadion {

std::shared_ptr<const CpuMesh> ListMeshes::find(const DrawItem& item) const {
  std::shared_ptr<const CpuMesh> rest = meshes_.find(item.mesh);
  if (!rest || item.figure == 0 || item.figure > figures_.size()) return rest;
  const Mesh* mesh = meshes_.source(item.mesh);
  if (!mesh || !mesh->skeleton) return rest;
  return poses_.find(*mesh, rest, figures_[item.figure - 1]);
}

}  // namespace stadion
