#pragma once
/// Leaves out the triangles that make no pixels, before OpenGL sees them.
///
/// A software rasteriser spends most of its time on small triangles. More than half of them are turned away
/// from the eye or lie between the middles of pixels; of the rest many are behind what has been drawn before.
/// To find them costs a few nanoseconds each, a tenth of what they cost there. The picture is the same: what
/// is not sure is kept (sieve_kernels.h).
///
/// Ownership  keeps its memory from frame to frame.
/// Threads    plain data, no GL.

#include "pipeline/draw_list/draw_list.h"
#include "pipeline/draw_list/instance_batches.h"
#include "pipeline/raster/sieve_kernels.h"

#include <cstdint>
#include <span>
#include <vector>

namespace stadion {

/// The fastest form on this machine.
const SieveKernels& bestSieve();

/// A mesh, coordinate by coordinate and corner by corner; all levels, as their indices follow each other.
struct SieveMesh {
  std::vector<float> x, y, z;         ///< of its vertices; room for a multiple of eight
  std::vector<std::int32_t> a, b, c;  ///< of its triangles, and seven behind the last one

  SieveMesh(const Mesh& mesh, std::span<const std::uint32_t> indices);
};

class TriangleSieve {
public:
  enum class Facing { CounterClockwise, Clockwise, Both };
  /// Of kept(), in indices.
  struct Range {
    std::uint32_t first = 0, count = 0;
  };

  TriangleSieve(std::uint32_t width, std::uint32_t height, const SieveKernels& kernels = bestSieve());

  /// Forgets what was kept.
  void clear() { used_ = 0; }
  /// Through whose eye things are seen from now on.
  void look(const DrawView& eye);
  /// What has been drawn for this eye so far: its depths, 1 at the near plane and 0 at the far one (height x
  /// width), rows from the bottom. What is behind is left out from now on.
  void hideBehind(std::span<const float> depths);
  /// What is sieved next, and where it stands.
  void place(const SieveMesh& mesh, const InstanceMatrix& model);
  /// Of the triangles of the mesh that was placed, from number `first` on.
  Range keep(std::uint32_t first, std::uint32_t count, Facing facing);
  std::span<const std::uint32_t> kept() const { return {kept_.data(), used_}; }

  /// Where the vertices of what was placed lie in the picture, as the kernels have it; null if that cannot be
  /// told of all.
  const PictureBounds* bounds() const { return told_ ? &bounds_ : nullptr; }
  const float* x() const { return px_.data(); }
  const float* y() const { return py_.data(); }
  const float* nearness() const { return nearness_.data(); }

private:
  const SieveKernels& kernels_;
  double halfWidth_, halfHeight_, oddX_, oddY_;
  Mat4 clip_ = Mat4::Identity();
  std::uint32_t width_, height_;
  DrawView eye_;
  std::vector<float> squares_;
  SeenSquares seen_{};
  const SieveMesh* mesh_ = nullptr;
  bool told_ = false;  ///< where all of its vertices lie
  std::vector<float> px_, py_, nearness_;
  PictureBounds bounds_{};
  std::vector<std::uint32_t> kept_;
  std::size_t used_ = 0;
};

}  // namespace stadion
