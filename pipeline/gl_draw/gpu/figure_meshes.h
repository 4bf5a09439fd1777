#pragma once
/// Figures in the poses of the draw list that is being drawn, in GL objects of one context.
///
/// Each figure has vertices of its own, which get a new pose once a frame for all views and shadow maps. It
/// shares the textures of the figure at rest.
///
/// Ownership  owns the GL objects; borrows the mesh cache and the store, which must outlive it.
/// Threads    the thread on which the context is current; its destructor too.

#include "engine/figure/figure_pose.h"
#include "engine/figure/skinning.h"
#include "pipeline/draw_list/draw_list.h"
#include "pipeline/gl_draw/gpu/mesh_cache.h"

#include <cstdint>
#include <unordered_map>
#include <vector>

namespace stadion {

class FigureMeshes {
public:
  FigureMeshes(MeshCache& meshes, const MeshStore& store) : meshes_(meshes), store_(store) {}

  /// Starts a draw list, which must stay until the next begin(). Frees figures that have gone.
  void begin(const DrawList& list);
  /// The mesh of a figure of the list, in its pose; at rest if the list has no such figure, null if it cannot
  /// be drawn.
  const GlMesh* find(MeshId id, std::uint32_t figure);

private:
  struct Held {
    MeshId id = kNoMesh;
    std::uint64_t hash = 0;
    GlMesh gl;
    FigureRecord playing{};
    bool isPosed = false;
    std::uint64_t usedIn = 0;  ///< number of the list
  };

  Held* held(MeshId id, const Mesh& mesh, const GlMesh& rest, std::uint32_t figure);
  void pose(const Mesh& mesh, Held& figure);

  MeshCache& meshes_;
  const MeshStore& store_;
  const DrawList* list_ = nullptr;
  std::uint64_t lists_ = 0;
  std::unordered_map<std::uint32_t, Held> figures_;
  FigurePose pose_;
  MorphedVertices morphed_;
  std::vector<SkinnedVertex> vertices_;
  std::vector<std::array<float, 4>> tangents_;
};

}  // namespace stadion
