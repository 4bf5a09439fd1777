#pragma once
/// Draws the surfaces of instances with OpenGL: what the opaque and the transparent pass have in common.
///
/// Threads  the thread on which the context is current.

#include "pipeline/gl_draw/gpu/indirect_draws.h"
#include "pipeline/gl_draw/passes/pass_context.h"

#include <cstdint>
#include <optional>

namespace stadion {

class SurfaceDrawing {
public:
  explicit SurfaceDrawing(const PassContext& with);

  /// The instances that one call draws: draw(mesh, first instance, count), with the mesh's vertex array and
  /// the instance matrices bound. `mesh` is that of the batch, `seen` what the view sees of it. `oneByOne`:
  /// each instance is drawn by a call of its own. Throws RunStopped between calls if the caller gives up.
  template <class Draw>
  void forEachCall(const GlMesh& mesh, const InstanceBatch& seen, bool oneByOne, const Draw& draw) {
    beginBatch(mesh, seen);
    const MeshParts parts = partsOf(mesh, seen.level);
    for (std::uint32_t done = 0, count = 0; done < seen.count; done += count) {
      const std::uint32_t first = seen.first + done;
      count = with_.pieces.togetherFrom(seen, done, parts);
      with_.pieces.next(first);
      const std::uint32_t step = oneByOne ? 1 : count;
      for (std::uint32_t i = first; i < first + count; i += step) {
        beginCall(i);
        draw(parts, i, step);
      }
    }
  }

  /// Prepares drawing a part of a mesh. Returns the program that draws it.
  const GlProgram& beginPart(const GlMesh& mesh, const GlSubmesh& part, SurfaceWrites writes);
  /// Draws a part of some instances.
  void drawPart(const GlMesh& mesh, const GlSubmesh& part, std::uint32_t first, std::uint32_t count,
                SurfaceWrites writes);
  /// Draws the parts of some instances; `opaqueOnly`: without the transparent ones.
  void drawOpaqueParts(const MeshParts& mesh, std::uint32_t first, std::uint32_t count, bool opaqueOnly);

  /// Draws the opaque parts of what the view sees of a batch. They may be collected until finishOpaque().
  void drawOpaque(const GlMesh& mesh, const InstanceBatch& seen, bool opaqueOnly);
  /// Draws what is collected.
  void finishOpaque();
  /// Forgets what an interrupted drawing has collected.
  void forgetOpaque();

private:
  void beginBatch(const GlMesh& mesh, const InstanceBatch& seen);
  void beginCall(std::uint32_t first);
  void collectOpaque(const MeshParts& mesh, const InstanceBatch& seen, bool opaqueOnly);

  const PassContext& with_;
  std::optional<IndirectDraws> indirect_;  ///< opaque parts still to be drawn; none: they are drawn at once
};

}  // namespace stadion
