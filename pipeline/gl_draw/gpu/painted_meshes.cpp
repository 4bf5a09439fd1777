#include "pipeline/gl_draw/gpu/painted_meshes.h"

#include <utility>

namespace stadion {

void PaintedMeshes::begin(const DrawList& list) {
  constexpr std::uint64_t kKept = 200;  // lists; a painted object may be out of sight for a while
  list_ = &list;
  ++lists_;
  std::erase_if(painted_, [&](const auto& entry) {
    return entry.second.usedIn + kKept < lists_ || !store_.holds(entry.first.mesh, entry.second.hash);
  });
}

const GlMesh& PaintedMeshes::find(const GlMesh& bare, const InstanceBatch& seen) {
  if (!list_ || seen.paint == 0 || seen.paint > list_->paints.size()) return bare;
  const Mesh* mesh = store_.find(seen.mesh);
  if (!mesh) return bare;
  const PaintRecord& paint = list_->paints[seen.paint - 1];
  const Key key{seen.mesh, seen.figure, seen.paint};
  auto at = painted_.find(key);
  // A figure that was out of sight for long has got other vertices.
  if (at != painted_.end() && !at->second.gl.place.isSame(bare.place)) {
    painted_.erase(at);
    at = painted_.end();
  }
  if (at == painted_.end())
    at = painted_.emplace(key, Held{mesh->hash, paint, meshes_.paintedCopyOf(*mesh, bare, paint), 0}).first;
  Held& held = at->second;
  held.usedIn = lists_;
  if (held.paint != paint) {
    held.paint = paint;
    meshes_.setPaint(*mesh, paint, held.gl);
  }
  return held.gl;
}

}  // namespace stadion
