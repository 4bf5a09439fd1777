#pragma once
/// Draws the sky, or the picture of an environment, where nothing else was drawn.
///
/// Threads  the thread on which the context is current.

#include "pipeline/gl/problem_log.h"
#include "pipeline/gl_draw/gpu/gpu_scene.h"

#include <map>
#include <memory>
#include <utility>

namespace stadion {

class SkyPass {
public:
  /// Fails with the compiler's message.
  static Result<std::unique_ptr<SkyPass>> create(const GlTable& gl, GpuScene& scene, Look look,
                                                 ProblemLog& problems);

  /// Expects that the blocks of the view are bound.
  void draw();

private:
  using Key = std::pair<int, bool>;  ///< tones, and whether a picture is seen

  SkyPass(const GlTable& gl, GpuScene& scene, Look look, ProblemLog& problems)
      : gl_(gl), scene_(scene), look_(look), problems_(problems), nothing_(gl) {}
  Result<GlProgram> build(const Key& key) const;
  const GlProgram& program();

  const GlTable& gl_;
  GpuScene& scene_;
  Look look_;
  ProblemLog& problems_;
  std::map<Key, GlProgram>
      programs_;           ///< the usual one is there from the start, the others from their first use
  GlVertexArray nothing_;  ///< the sky's triangle has no vertex data
};

}  // namespace stadion
