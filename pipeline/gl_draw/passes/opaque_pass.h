#pragma once
/// Draws the opaque objects of a view, instanced by mesh.
///
/// Order    begins with what is known of a list that Cull still fills. Where a processor rasterises with one
///          sample a pixel, triangles that cover no pixel are removed (raster/triangle_culler.h), and the
///          nearest quarter of the objects is drawn first: triangles behind it are removed, too.
/// Threads  the thread on which the context is current.

#include "pipeline/gl_draw/passes/small_object_pass.h"
#include "pipeline/gl_draw/passes/surface_drawing.h"
#include "pipeline/raster/triangle_culler.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace stadion {

class OpaquePass {
public:
  OpaquePass(const PassContext& with, SurfaceDrawing& surfaces);

  /// Draws all opaque objects that `small` has not drawn. Expects that the view's picture has begun. Throws
  /// RunStopped if the caller gives up.
  void draw(const DrawView& from, std::uint32_t view, const SmallObjectPass& small);

private:
  struct Distances {
    float from, to;  ///< from the viewer, at least and less than [m]
  };

  std::optional<float> nearQuarter(std::uint32_t view, const SmallObjectPass& small);
  void drawBatches(std::uint32_t view, const SmallObjectPass& small, Distances within);
  void drawBatch(const GlMesh& mesh, const InstanceBatch& seen, const SmallObjectPass& small,
                 Distances within);
  void keepSeen(const MeshParts& mesh, std::uint32_t first, std::uint32_t count, bool mirrored,
                const SmallObjectPass& small, Distances within);
  void drawSeen(const MeshParts& mesh, std::uint32_t first, std::uint32_t count);

  const PassContext& with_;
  SurfaceDrawing& surfaces_;
  std::optional<TriangleCuller> culler_;     ///< only on machines where culling saves time
  std::vector<TriangleCuller::Range> seen_;  ///< triangles by part and instance, of the current call
  GlBuffer seenIndices_;
  std::vector<float> depths_, distances_;
};

}  // namespace stadion
