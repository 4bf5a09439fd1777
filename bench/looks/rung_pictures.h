#pragma once
/// Draws a list by any rung, and as the reference: 64 samples a pixel, averaged in linear light.
///
/// Cost       Processor time: of this thread for the CPU renderer, which has no other here; of the process
///            for OpenGL, whose rasteriser has threads of its own.
/// Ownership  the mesh store must outlive it.
/// Threads    the thread that made it.
/// Errors     as of a Renderer.

#include "bench/looks/rungs.h"
#include "engine/display/wall_file.h"
#include "pipeline/cpu_draw/cpu_renderer.h"
#include "pipeline/picture/picture.h"
#include "pipeline/target/target.h"

#include <memory>
#include <vector>

namespace stadion::bench {

class OpenGlPictures;

/// The pictures of all views of a list, and what they cost.
struct DrawnViews {
  std::vector<Picture> views;
  double ms = 0;  ///< processor time a view
};

class RungPictures {
public:
  /// Pictures of this size. `openGl`: this OpenGL is loaded, too; fails if it cannot be.
  static Result<std::unique_ptr<RungPictures>> create(const MeshStore& meshes, PixelSize size,
                                                      std::optional<GlProviderKind> openGl);
  ~RungPictures();

  Result<DrawnViews> draw(const DrawList& list, const NamedRung& rung);
  /// One sample a pixel, 64 times, each moved by an eighth of a pixel in one of the axes.
  Result<std::vector<Picture>> reference(const DrawList& list);

private:
  RungPictures(const MeshStore& meshes, PixelSize size);
  Result<CpuRenderer*> rendererOf(const PictureRung& rung);
  Result<DrawnViews> drawWith(Renderer& renderer, const DrawList& list, int clock) const;

  /// What draws one look.
  struct LookRoom {
    std::unique_ptr<CpuRoom> room;
    std::unique_ptr<CpuRenderer> renderer;
  };

  const MeshStore& meshes_;
  PixelSize size_;
  DrawPool pool_{1};
  LookRoom full_, plain_;
  std::unique_ptr<OpenGlPictures> openGl_;  ///< null: not asked for
};

}  // namespace stadion::bench
