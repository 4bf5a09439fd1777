#pragma once
/// The meshes that a draw list shows: figures in their poses.
///
/// Ownership  borrows the cache, the poses and the list.
/// Threads    any, at once.

#include "pipeline/cpu_draw/mesh/cpu_mesh.h"
#include "pipeline/cpu_draw/mesh/posed_meshes.h"
#include "pipeline/draw_list/draw_list.h"

#include <memory>
#include <span>

namespace stadion {

class ListMeshes {
public:
  ListMeshes(CpuMeshCache& meshes, PosedMeshes& poses, std::span<const FigureRecord> figures)
      : meshes_(meshes), poses_(poses), figures_(figures) {}

  /// Null if it cannot be drawn.
  std::shared_ptr<const CpuMesh> find(const DrawItem& item) const;

private:
  CpuMeshCache& meshes_;
  PosedMeshes& poses_;
  std::span<const FigureRecord> figures_;
};

}  // namespace stadion
