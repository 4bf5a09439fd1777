#pragma once
/// What the passes of one renderer share.
///
/// Ownership  borrows everything; the renderer owns it.
/// Threads    the thread on which the context is current.

#include "engine/base/run_stopped.h"
#include "pipeline/gl_draw/gpu/gpu_scene.h"
#include "pipeline/gl_draw/passes/eye_buffers.h"
#include "pipeline/gl_draw/sampling/draw_pieces.h"

#include <cstdint>
#include <functional>

namespace stadion {

/// Lets the caller of a drawing stop it.
class StopRequest {
public:
  /// Asks `giveUp` from now on, which must stay until the drawing ends. Empty: nothing stops it.
  void ask(const std::function<bool()>& giveUp) { giveUp_ = giveUp ? &giveUp : nullptr; }
  /// Throws RunStopped if the caller has given up.
  void check() const {
    if (giveUp_ && (*giveUp_)()) throw RunStopped();
  }

private:
  const std::function<bool()>* giveUp_ = nullptr;
};

struct PassContext {
  const GlTable& gl;
  GpuScene& scene;
  EyeBuffers& buffers;
  DrawPieces& pieces;
  const StopRequest& stop;
  std::uint32_t width, height;  ///< size of a picture [pixels]

  std::uint64_t pixels() const { return std::uint64_t{width} * height; }
};

}  // namespace stadion
