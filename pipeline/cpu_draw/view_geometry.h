#pragma once
/// How the camera of a picture maps the scene to pixels and depths.
///
/// Depth  grows towards the eye and is linear in the picture (kernels/kernel_data.h).

#include "engine/maths/maths.h"
#include "pipeline/cpu_draw/kernels/kernel_data.h"

#include <array>
#include <cstdint>
#include <optional>

namespace stadion {

struct ViewGeometry {
  int width = 0, height = 0;  ///< [pixels]
  /// World axes relative to the list's origin to x * w, y * w in pixels, and w; in a parallel projection the
  /// last row is the depth and w is 1.
  std::array<std::array<double, 4>, 3> rows{};
  bool parallel = false;
  float leastDepth = 0;  ///< smallest depth before the eye
  float mostDepth = 0;   ///< at the near plane
  float farDepth = 0;    ///< at the far plane

  /// Nothing if the projection is neither a perspective nor a parallel one.
  static std::optional<ViewGeometry> of(const Mat4& projection, const Mat4& view, std::uint32_t width,
                                        std::uint32_t height);
  /// For an instance with this model matrix (3 x 4, row major).
  PixelMatrix placing(const std::array<float, 12>& model) const;
};

}  // namespace stadion
