#pragma once
/// Meshes with the paints of the draw list that is being drawn, in GL objects of one context.
///
/// A painted mesh has materials of its own. It shares vertices, indices and textures with the mesh of which it
/// is a copy: that of the file, or a figure in its pose.
///
/// Ownership  owns the GL objects; borrows the mesh cache and the store, which must outlive it.
/// Threads    the thread on which the context is current; its destructor too.

#include "pipeline/draw_list/instance_batches.h"
#include "pipeline/gl_draw/gpu/mesh_cache.h"

#include <compare>
#include <cstdint>
#include <map>

namespace stadion {

class PaintedMeshes {
public:
  PaintedMeshes(MeshCache& meshes, const MeshStore& store) : meshes_(meshes), store_(store) {}

  /// Starts a draw list, which must stay until the next begin(). Frees paints that have gone.
  void begin(const DrawList& list);
  /// The mesh of a batch in its paint; `bare` itself if the list has no such paint.
  const GlMesh& find(const GlMesh& bare, const InstanceBatch& seen);

private:
  struct Key {
    MeshId mesh;
    std::uint32_t figure, paint;
    auto operator<=>(const Key&) const = default;
  };
  struct Held {
    std::uint64_t hash = 0;  ///< of the mesh
    PaintRecord paint;
    GlMesh gl;
    std::uint64_t usedIn = 0;  ///< number of the list
  };

  MeshCache& meshes_;
  const MeshStore& store_;
  const DrawList* list_ = nullptr;
  std::uint64_t lists_ = 0;
  std::map<Key, Held> painted_;
};

}  // namespace stadion
