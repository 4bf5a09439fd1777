#pragma once
/// The same draw list, drawn with OpenGL and by the CPU renderer.

#include "pipeline/cpu_draw/cpu_renderer.h"
#include "tests/pipeline/gl_draw/renderer_scene.h"

namespace stadion::test {

/// How two pictures differ, over all colour channels.
struct PictureDifference {
  double mean = 0;   ///< of 255
  double alike = 0;  ///< part of the channels that differ by 8 at most
  int most = 0;
};
PictureDifference difference(const Picture& a, const Picture& b);

/// Draws a view with a pool of so many threads.
Picture drawnByCpu(const MeshStore& meshes, const DrawList& list, std::uint32_t width, std::uint32_t height,
                   const PictureRung& rung = {}, std::size_t threads = 1,
                   const DrawKernels* kernels = nullptr, std::uint32_t view = 0);
Picture drawnByOpenGl(const MeshStore& meshes, const DrawList& list, std::uint32_t width,
                      std::uint32_t height, const RenderQuality& quality = {}, std::uint32_t view = 0);

/// The mean of side x side pictures with one sample a pixel, each moved by a part of a pixel, in linear
/// light.
Picture referencePicture(const MeshStore& meshes, DrawList list, std::uint32_t width, std::uint32_t height,
                         int side = 8, std::uint32_t view = 0);

}  // namespace stadion::test
