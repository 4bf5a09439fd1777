#pragma once
/// Draws the shadow maps of a list, as far as they have changed, and binds them (shadow_maps.h).
///
/// Errors   if this OpenGL cannot draw shadow maps, there are no shadows, and the problem is reported.
/// Threads  the thread on which the context is current.

#include "pipeline/gl_draw/passes/pass_context.h"
#include "pipeline/gl_draw/passes/shadow_maps.h"

#include <memory>

namespace stadion {

class ShadowPass {
public:
  ShadowPass(const PassContext& with, ClipDepth clip, ProblemLog& problems)
      : with_(with), clip_(clip), problems_(problems) {}

  /// Expects a list with a light that casts shadows. Returns whether the maps can be used.
  bool draw(const DrawShadows& shadows);

private:
  const PassContext& with_;
  ClipDepth clip_;
  ProblemLog& problems_;
  std::unique_ptr<ShadowMaps> maps_;  ///< from the first list with shadows on
  bool failed_ = false;
};

}  // namespace stadion
