#pragma once
/// The meshes that a draw list shows: figures in their poses, and paints.
///
/// Ownership  borrows the cache, the poses and the list.
/// Threads    any, at once.

#include "pipeline/cpu_draw/mesh/cpu_mesh.h"
#include "pipeline/cpu_draw/mesh/mesh_paints.h"
#include "pipeline/cpu_draw/mesh/posed_meshes.h"
#include "pipeline/draw_list/draw_list.h"

#include <memory>

namespace stadion {

class ListMeshes {
public:
  ListMeshes(CpuMeshCache& meshes, PosedMeshes& poses, MeshPaints& paints, const DrawList& list)
      : meshes_(meshes), poses_(poses), paints_(paints), list_(list) {}

  /// Null if it cannot be drawn.
  std::shared_ptr<const CpuMesh> find(const DrawItem& item) const;
  /// What the item's paint makes of its mesh; null if it has none.
  std::shared_ptr<const MeshPaint> paintOf(const DrawItem& item) const;

private:
  CpuMeshCache& meshes_;
  PosedMeshes& poses_;
  MeshPaints& paints_;
  const DrawList& list_;
};

}  // namespace stadion
