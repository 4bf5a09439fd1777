#pragma once
/// Draws the sky where nothing else was drawn.
///
/// Threads  the thread on which the context is current.

#include "pipeline/gl_draw/gpu/gpu_scene.h"

#include <memory>

namespace stadion {

class SkyPass {
public:
  /// Fails with the compiler's message.
  static Result<std::unique_ptr<SkyPass>> create(const GlTable& gl, GpuScene& scene, Look look);

  /// Expects that the blocks of the view are bound.
  void draw();

private:
  SkyPass(const GlTable& gl, GpuScene& scene, GlProgram program)
      : scene_(scene), program_(std::move(program)), nothing_(gl) {}

  GpuScene& scene_;
  GlProgram program_;
  GlVertexArray nothing_;  ///< the sky's triangle has no vertex data
};

}  // namespace stadion
