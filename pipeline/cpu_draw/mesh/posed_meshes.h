#pragma once
/// Figures in the poses of the present frames. Each pose is made once, for all walls, eyes and shadow maps.
///
/// Threads  any, at once. The first that asks for a pose makes it while others that ask for it wait.
/// Memory   a pose is kept while its frame or the one after it is drawn; its memory then serves a new one.

#include "engine/asset/mesh.h"
#include "engine/figure/figure_record.h"
#include "pipeline/cpu_draw/mesh/cpu_mesh.h"

#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

namespace stadion {

class PosedMeshes {
public:
  /// `rest`: the CpuMesh of `mesh`, which has a skeleton.
  std::shared_ptr<const CpuMesh> find(const Mesh& mesh, const std::shared_ptr<const CpuMesh>& rest,
                                      const FigureRecord& playing);
  /// A list of this frame is drawn from now on.
  void begin(std::uint64_t frame);
  std::size_t size() const;

private:
  struct Pose {
    FigureRecord playing;
    std::uint64_t usedIn = 0;  ///< frame
    std::mutex mutex;          ///< held while it is made
    std::shared_ptr<CpuMesh> mesh;
  };
  /// Meshes of one figure that nothing draws any more.
  class Spares;
  struct Figure {
    std::vector<std::shared_ptr<Pose>> poses;
    std::shared_ptr<Spares> spares;
  };

  /// The pose, and the spare meshes of its figure.
  std::pair<std::shared_ptr<Pose>, std::shared_ptr<Spares>> poseOf(const std::shared_ptr<const CpuMesh>& rest,
                                                                   const FigureRecord& playing);

  mutable std::mutex mutex_;
  std::uint64_t frame_ = 0;                                   ///< the newest
  std::map<std::shared_ptr<const CpuMesh>, Figure> figures_;  ///< by the figure at rest
};

}  // namespace stadion
