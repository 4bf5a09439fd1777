#pragma once
/// Draws small objects itself, into a picture that OpenGL then continues.
///
/// A software rasteriser is made for large triangles. For a triangle of two or three pixels it sets up a
/// program's run over a block of sixteen, which takes as long as fifty such pixels. This makes up most of the
/// cost of a show's distant objects. Here eight small triangles are set up at a time. The rules are OpenGL's
/// (raster_kernels.h), so the picture is the same except for rounding: the last bit of a colour, and now and
/// then a pixel with its middle less than a hundredth of a pixel from an edge.
///
/// What      objects without textures or transparency, in the plain look, at most kMostSmall pixels wide and
///           high, wholly in the picture and behind the near plane, under directional lights in clear air.
///           OpenGL draws objects that the picture's edge clips, because it makes other triangles of them.
///           Ownership keeps its memory from frame to frame, and two pictures.
/// Threads   plain data, no GL.

#include "pipeline/draw_list/draw_list.h"
#include "pipeline/raster/raster_kernels.h"
#include "pipeline/raster/triangle_culler.h"
#include "pipeline/shader/uniform_blocks.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace stadion {

/// The fastest form on this machine.
const RasterKernels& bestRaster();

/// The data of a mesh that lighting its corners needs. All levels share them.
struct MeshShading {
  std::vector<float> nx, ny, nz;  ///< normals; room for a multiple of eight
  std::vector<float> r, g, b;     ///< as they are stored, 0 .. 1
  std::vector<MaterialBlock> materials;

  explicit MeshShading(const Mesh& mesh);
};

class SmallObjectRasterizer {
public:
  SmallObjectRasterizer(std::uint32_t width, std::uint32_t height,
                        const RasterKernels& kernels = bestRaster());

  /// Returns true if things that are lit so can be drawn here.
  static bool serves(const DrawView& eye, const SceneBlock& scene);

  /// An empty picture of that colour, for an eye and a scene that are served.
  void begin(const DrawView& eye, const SceneBlock& scene, const std::array<float, 3>& background);
  /// Places the mesh to draw next. Returns false if it is not small.
  bool place(const CullerMesh& mesh, const MeshShading& shading, const InstanceMatrix& model);
  /// Draws triangles of the placed object, from number `first` on, with their vertices within [firstVertex,
  /// endVertex). Returns how many passed the culler.
  std::uint32_t draw(std::uint32_t first, std::uint32_t count, TriangleCuller::Facing facing,
                     const MaterialBlock& material, std::uint32_t firstVertex, std::uint32_t endVertex);

  /// begin()'s picture (height x width), rows from the bottom: RGBA, 8 bits each, and depths, 1 at the near
  /// plane and 0 at the far one.
  std::span<const std::uint32_t> colours() const { return colours_; }
  std::span<const float> depths() const { return depths_; }

private:
  const RasterKernels& kernels_;
  int width_, height_;
  TriangleCuller culler_;
  std::vector<std::uint32_t> colours_;
  std::vector<float> depths_;
  std::vector<float> r_, g_, b_;  ///< lit colours of the placed object's vertices
  std::vector<ShadingLight> lights_;
  Shading by_{};
  const MeshShading* shading_ = nullptr;
  RasterTarget target_{};
  float nearest_ = 0;  ///< the near plane: nothing is nearer [1/m]
};

}  // namespace stadion
