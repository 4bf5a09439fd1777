#pragma once
/// What one OpenGL context holds of the scene that it draws. All passes share it.
///
///   meshes()     vertices, indices, materials and textures of the meshes drawn so far
///   surfaces()   the programs that draw surfaces
///   instances()  where the meshes of the current draw list stand
///   calls()      draw calls, and the state that they need
///
/// Besides, it holds the uniform blocks of the views and of what they share: sky and lights.
///
/// Ownership  owns the GL objects; the function table, the mesh store and the problem log must outlive it.
/// Threads    the thread on which the context is current; its destructor too.
/// Errors     reported to the log.

#include "pipeline/draw_list/draw_list.h"
#include "pipeline/gl/problem_log.h"
#include "pipeline/gl_draw/gpu/draw_calls.h"
#include "pipeline/gl_draw/gpu/environment_texture.h"
#include "pipeline/gl_draw/gpu/figure_meshes.h"
#include "pipeline/gl_draw/gpu/frame_data.h"
#include "pipeline/gl_draw/gpu/list_instances.h"
#include "pipeline/gl_draw/gpu/mesh_cache.h"
#include "pipeline/gl_draw/gpu/painted_meshes.h"
#include "pipeline/gl_draw/gpu/surface_programs.h"
#include "pipeline/gl_draw/gpu/upload_ring.h"
#include "pipeline/shader/look.h"
#include "pipeline/shader/uniform_blocks.h"
#include "pipeline/surface/environment_lights.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace stadion {

class GpuScene {
public:
  /// `sortsObjects`: transparent objects are drawn far to near, instead of as they are listed.
  GpuScene(const GlTable& gl, const MeshStore& store, RenderQuality quality, bool sortsObjects,
           ProblemLog& problems);

  /// Returns true if triangles are removed before OpenGL sees them (TriangleCuller). It pays where a
  /// processor rasterises with one sample a pixel: most triangles of distant objects cover no pixel.
  bool cullsTriangles() const { return cullsTriangles_; }
  /// Returns true if opaque objects and shadow casters are drawn by IndirectDraws.
  bool drawsIndirectly() const { return drawsIndirectly_; }
  /// Where the data of a frame is uploaded; null: each kind of it has a buffer of its own.
  UploadRing* uploads() { return uploads_ ? &*uploads_ : nullptr; }

  /// Starts a draw list: frees meshes that the store has freed, and takes up the first items. `probe` gets
  /// uploads and the waits for Cull; null = none.
  void begin(const DrawList& list, FrameProbe* probe);
  /// Uploads sky and lights of a list, and chooses the programs for them. `shadowed`: shadow maps are bound.
  void light(const DrawList& list, bool shadowed);
  /// Returns true if light() was called: nothing can be drawn before.
  bool isLit() const { return isLit_; }
  /// The block that light() uploaded.
  const SceneBlock& lighting() const { return lighting_; }
  /// The tones of the list, as SurfaceTraits has them.
  int tones() const { return tones_; }
  /// Returns true if the picture of an environment is seen in place of the sky.
  bool hasBackground() const { return hasBackground_; }
  /// Returns true if the sky has one colour: then it is cleared, not drawn.
  bool skyIsFlat() const { return skyIsFlat_; }

  /// Makes blocks for at least so many views.
  void growTo(std::size_t views);
  std::size_t views() const { return views_.size(); }
  /// Uploads a view's block.
  void setView(std::size_t view, const ViewBlock& block);
  /// Binds the blocks of a view, and of sky and lights, for all programs.
  void bindView(std::size_t view) const;

  MeshCache& meshes() { return meshes_; }
  const MeshCache& meshes() const { return meshes_; }
  SurfacePrograms& surfaces() { return surfaces_; }
  ListInstances& instances() { return instances_; }
  const InstanceBatches& batches() const { return instances_.batches(); }
  DrawCalls& calls() { return calls_; }
  const DrawCalls& calls() const { return calls_; }

  /// The batch's mesh; null if no instance is seen or the mesh cannot be drawn.
  const GlMesh* meshOf(const InstanceBatch& seen) {
    if (seen.count == 0) return nullptr;
    const GlMesh* mesh = seen.figure != 0 ? figures_.find(seen.mesh, seen.figure) : meshes_.find(seen.mesh);
    return mesh && seen.paint != 0 ? &painted_.find(*mesh, seen) : mesh;
  }

private:
  UploadRing* withRing(GlUse use);
  Surroundings surround(const DrawSky& sky, const std::shared_ptr<const EnvironmentLight>& light);

  const GlTable& gl_;
  Look look_;
  ProblemLog& problems_;
  DrawCalls calls_;
  bool cullsTriangles_, drawsIndirectly_;
  std::optional<UploadRing> uploads_;
  MeshCache meshes_;
  FigureMeshes figures_;
  PaintedMeshes painted_;
  SurfacePrograms surfaces_;
  ListInstances instances_;
  EnvironmentLights environments_;
  EnvironmentTexture environment_;
  bool reflections_;
  FrameData scene_;
  std::vector<FrameData> views_;  ///< uniform blocks of the views; at least one
  SceneBlock lighting_{};
  bool isLit_ = false, skyIsFlat_ = false, isSurrounded_ = false, hasBackground_ = false;
  int tones_ = 0;
};

}  // namespace stadion
