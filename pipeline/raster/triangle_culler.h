#pragma once
/// Removes triangles that make no pixels, before OpenGL sees them.
///
/// A software rasteriser spends most of its time on small triangles. More than half of them face away from
/// the eye or lie between the middles of pixels. Of the rest many are behind surfaces drawn before. Finding
/// them costs a few nanoseconds each, a tenth of their cost in OpenGL. The picture is the same: uncertain
/// triangles are kept (cull_kernels.h).
///
/// Ownership  keeps its memory from frame to frame.
/// Threads    plain data, no GL.

#include "pipeline/draw_list/draw_list.h"
#include "pipeline/draw_list/instance_batches.h"
#include "pipeline/raster/cull_kernels.h"

#include <cstdint>
#include <span>
#include <vector>

namespace stadion {

/// The fastest form on this machine.
const CullKernels& bestCuller();

/// A mesh, coordinate by coordinate and corner by corner; all levels, in the order of their indices.
struct CullerMesh {
  std::vector<float> x, y, z;         ///< by vertex: coordinates; padded to a multiple of eight
  std::vector<std::int32_t> a, b, c;  ///< by triangle: corners; seven more follow the last one

  CullerMesh(const Mesh& mesh, std::span<const std::uint32_t> indices);
};

class TriangleCuller {
public:
  enum class Facing { CounterClockwise, Clockwise, Both };
  /// A range of kept(), in indices.
  struct Range {
    std::uint32_t first = 0, count = 0;
  };

  TriangleCuller(std::uint32_t width, std::uint32_t height, const CullKernels& kernels = bestCuller());

  /// Forgets the kept triangles.
  void clear() { used_ = 0; }
  /// Through whose eye things are seen from now on.
  void setView(const DrawView& eye);
  /// Removes from now on triangles behind a picture drawn earlier for this eye. `depths`: 1 at the near
  /// plane, 0 at the far one (height x width), rows from the bottom.
  void hideBehind(std::span<const float> depths);
  /// Places the next mesh.
  void place(const CullerMesh& mesh, const InstanceMatrix& model);
  /// Filters triangles of the placed mesh, from number `first` on.
  Range keep(std::uint32_t first, std::uint32_t count, Facing facing);
  std::span<const std::uint32_t> kept() const { return {kept_.data(), used_}; }

  /// Returns the bounds of the placed vertices in the picture, as the kernels have them. Null if they are not
  /// known for all vertices.
  const PictureBounds* bounds() const { return told_ ? &bounds_ : nullptr; }
  const float* x() const { return px_.data(); }
  const float* y() const { return py_.data(); }
  const float* nearness() const { return nearness_.data(); }

private:
  const CullKernels& kernels_;
  double halfWidth_, halfHeight_, oddX_, oddY_;
  Mat4 clip_ = Mat4::Identity();
  std::uint32_t width_, height_;
  DrawView eye_;
  std::vector<float> squares_;
  SeenSquares seen_{};
  const CullerMesh* mesh_ = nullptr;
  bool told_ = false;  ///< the places of all its vertices are known
  std::vector<float> px_, py_, nearness_;
  PictureBounds bounds_{};
  std::vector<std::uint32_t> kept_;
  std::size_t used_ = 0;
};

}  // namespace stadion
