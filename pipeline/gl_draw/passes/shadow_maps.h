#pragma once
/// Depth as the light sees it: the maps that surfaces look up whether the light reaches them.
///
/// Depths are 1 where a ring begins, towards the light, and 0 where it ends.
///
/// One texture holds the rings of a draw list side by side, two by two. Still objects are drawn into a
/// texture of their own, which is kept as long as they stay the same. In a frame with movers, the part that
/// they cover is copied back, and they are drawn over it. A frame in which nothing moves costs nothing.
///
/// Same pixels  what is in the maps follows from the list alone, not from what was drawn before it.
/// Ownership    owns its GL objects. Threads: the thread on which its context is current.

#include "pipeline/draw_list/draw_list.h"
#include "pipeline/draw_list/instance_batches.h"
#include "pipeline/gl/gl_program.h"
#include "pipeline/gl_draw/gpu/gpu_scene.h"
#include "pipeline/gl_draw/gpu/indirect_draws.h"

#include <array>
#include <functional>
#include <optional>

namespace stadion {

class ShadowMaps {
public:
  /// `ring`: where data is uploaded; null = into buffers of its own. `indirect`: casters are drawn by
  /// IndirectDraws, which expects that meshes share pages. Fails with the compiler's words, or if the context
  /// has no such framebuffers.
  static Result<std::unique_ptr<ShadowMaps>> create(const GlTable& gl, ClipDepth clip, UploadRing* ring,
                                                    bool indirect);

  /// Brings the maps up to date. `between` is called now and then; it may throw. Leaves another framebuffer
  /// bound, and another viewport.
  void update(const DrawShadows& shadows, GpuScene& scene, const std::function<void()>& between);
  /// For the surface shaders: the texture at kShadowUnit, the block at kShadowBinding.
  void bind() const;

private:
  ShadowMaps(const GlTable& gl, ClipDepth clip, UploadRing* ring, bool indirect, GlProgram program);

  /// Texels of the whole texture: x, y, width, height.
  struct Area {
    GLint x = 0, y = 0;
    GLsizei width = 0, height = 0;
  };
  struct Ring {
    std::uint64_t stillKey = 0, movingKey = 0;
    bool drawn = false;
    Area moved;  ///< the area that the moving objects cover
  };

  static Area tileOf(std::size_t ring);
  static Area coveredBy(const DrawShadowRing& ring, const Area& tile);
  static Area around(const Area& a, const Area& b);
  void updateRing(const DrawShadows& shadows, std::size_t index, GpuScene& scene,
                  const std::function<void()>& between);
  void drawCasters(const DrawShadows& shadows, std::size_t index, std::span<const DrawItem> casters,
                   GpuScene& scene, const std::function<void()>& between);
  void setView(const DrawShadows& shadows, std::size_t index);
  void collect(const GlMesh& mesh, const InstanceBatch& batch);
  void drawBatch(const GlMesh& mesh, const InstanceBatch& batch, const std::function<void()>& between);
  void drawPart(const GlMesh& mesh, const GlSubmesh& part, GLsizei instances);
  const GlProgram& programFor(const GlSubmesh& part);
  void restore(const Area& area);
  void fillBlock(const DrawShadows& shadows);

  const GlTable& gl_;
  ClipDepth clip_;
  GlProgram program_;
  /// Programs for surfaces with holes, without pictures and with them; made at first use. If making fails,
  /// such a surface casts a whole shadow.
  std::array<std::optional<GlProgram>, 4> masked_;
  std::array<bool, 4> maskedFailed_{};
  GlTexture still_, shown_;
  GlFramebuffer intoStill_, intoShown_;
  FrameData view_, block_, instances_;
  std::optional<IndirectDraws>
      indirect_;  ///< casters without holes, still to be drawn; none: they are drawn at once
  InstanceBatches batches_;
  std::vector<DrawItem> sorted_;
  std::array<Ring, kShadowRings> rings_;
};

}  // namespace stadion
