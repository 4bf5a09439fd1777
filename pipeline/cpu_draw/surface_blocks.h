#pragma once
/// Collects what shading needs of the visible triangles of a picture.
///
/// Threads  pure.

#include "pipeline/cpu_draw/kernels/kernel_data.h"
#include "pipeline/cpu_draw/picture_setup.h"
#include "pipeline/shader/look.h"

namespace stadion {

class SurfaceBlocks {
public:
  /// `scene`: lights corners in the plain look. `eye`: for haze.
  SurfaceBlocks(const DrawKernels& kernels, const PictureSetup& picture, Look look,
                const SceneParameters& scene, const ViewParameters& view)
      : kernels_(kernels), picture_(picture), look_(look), scene_(scene), view_(view) {}

  /// Returns true if fillExtras() has something to fill.
  bool hasExtras() const { return picture_.hasExtras(); }
  /// One for each. Those of meshes that have none stay as they are.
  void fillExtras(std::span<const TriangleRecord* const> triangles, SurfaceExtra* out) const;
  /// One block for each.
  void fill(std::span<const TriangleRecord* const> triangles, SurfaceBlock* out) const;

private:
  using Corner = std::array<double, 3>;
  void fillStretch(std::span<const TriangleRecord* const> triangles, SurfaceBlock* out) const;
  void weighClipped(const TriangleRecord& record, SurfaceBlock& out) const;
  static void fillWeights(const std::array<Corner, 3>& corners, SurfaceBlock& out);
  void lightCorner(const MaterialParameters& material, float* corner) const;

  const DrawKernels& kernels_;
  const PictureSetup& picture_;
  Look look_;
  const SceneParameters& scene_;
  const ViewParameters& view_;
};

}  // namespace stadion
