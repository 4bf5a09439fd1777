#pragma once
/// A context of OpenGL with a renderer in the full look, current on the thread that made it.

#include "engine/display/wall_file.h"
#include "pipeline/gl_draw/gl_renderer.h"
#include "pipeline/target/target.h"

#include <memory>

namespace stadion::bench {

class OpenGlPictures {
public:
  static Result<std::unique_ptr<OpenGlPictures>> create(const MeshStore& meshes, PixelSize size,
                                                        GlProviderKind kind);
  ~OpenGlPictures();

  Renderer& renderer() { return *renderer_; }

private:
  OpenGlPictures() = default;

  std::unique_ptr<GlProvider> provider_;
  std::unique_ptr<Target> target_;
  std::unique_ptr<GlRenderer> renderer_;
};

}  // namespace stadion::bench
