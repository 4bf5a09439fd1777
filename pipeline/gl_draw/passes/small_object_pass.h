#pragma once
/// Draws small opaque objects without OpenGL, into the empty picture that OpenGL then continues
/// (raster/small_object_rasterizer.h).
///
/// Where    in the plain look, if a processor rasterises and one sample a pixel is taken, and if a view has
///          enough triangles to make it pay.
/// Threads  the thread on which the context is current. Gives the turn away meanwhile: other walls draw.

#include "pipeline/gl_draw/passes/pass_context.h"
#include "pipeline/raster/small_object_rasterizer.h"

#include <cstdint>
#include <mutex>
#include <optional>
#include <vector>

namespace stadion {

class SmallObjectPass {
public:
  /// Draws nothing if this quality has no such pass.
  SmallObjectPass(const PassContext& with, RenderQuality quality);

  /// Draws the small objects of a view. Returns whether OpenGL must go on with picture(). `turn` is given
  /// away meanwhile, if it is held and nothing is timed. Throws RunStopped if the caller gives up.
  bool draw(const DrawView& from, std::uint32_t view, std::unique_lock<std::mutex>& turn, FrameProbe* probe);
  /// After draw() returned true.
  const SmallObjectRasterizer& picture() const { return *small_; }
  /// Returns true if the instance was drawn, in the current view.
  bool drew(std::uint32_t instance) const { return instance < drew_.size() && drew_[instance]; }

private:
  bool pays(std::uint32_t view);
  void drawAll(std::uint32_t view, std::unique_lock<std::mutex>* away);
  const GlMesh* meshOf(const InstanceBatch& seen, std::unique_lock<std::mutex>* away);
  bool drawOne(const MeshParts& mesh, const InstanceBatch& batch, std::uint32_t instance);

  const PassContext& with_;
  std::optional<SmallObjectRasterizer> small_;
  std::vector<bool> drew_;  ///< by instance
};

}  // namespace stadion
