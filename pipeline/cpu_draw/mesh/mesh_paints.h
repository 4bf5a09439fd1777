#pragma once
/// The materials of painted meshes. Each is made once, for all walls and eyes.
///
/// Threads  any, at once.
/// Memory   a paint is kept while its frame or the one after it is drawn.

#include "engine/asset/mesh.h"
#include "engine/published/paint.h"
#include "pipeline/cpu_draw/mesh/cpu_mesh.h"
#include "pipeline/shader/look.h"

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

namespace stadion {

/// What a paint makes of a mesh.
struct MeshPaint {
  bool seeThrough = false;                    ///< all its parts are transparent, and none is masked
  std::vector<MaterialParameters> materials;  ///< instead of the mesh's
};

class MeshPaints {
public:
  explicit MeshPaints(Look look) : look_(look) {}

  /// `bare`: the CpuMesh of `mesh`.
  std::shared_ptr<const MeshPaint> find(const Mesh& mesh, const std::shared_ptr<const CpuMesh>& bare,
                                        const PaintRecord& paint);
  /// A list of this frame is drawn from now on.
  void begin(std::uint64_t frame);
  std::size_t size() const;

private:
  using Key = std::pair<std::shared_ptr<const CpuMesh>, std::array<float, 7>>;
  struct Held {
    std::shared_ptr<const MeshPaint> paint;
    std::uint64_t usedIn = 0;  ///< frame
  };
  std::shared_ptr<const MeshPaint> made(const Mesh& mesh, const CpuMesh& bare,
                                        const PaintRecord& paint) const;

  Look look_;
  mutable std::mutex mutex_;
  std::uint64_t frame_ = 0;  ///< the newest
  std::map<Key, Held> paints_;
};

}  // namespace stadion
