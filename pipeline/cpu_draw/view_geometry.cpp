#include "pipeline/cpu_draw/view_geometry.h"

#include <cmath>

namespace stadion {
namespace {

constexpr float kBeforeEverything = -1e30f;

/// Clip coordinates to pixels, still times w.
std::array<double, 4> pixelRow(const Mat4& clip, int axis, double size) {
  std::array<double, 4> row;
  for (int k = 0; k < 4; ++k) row[static_cast<std::size_t>(k)] = 0.5 * size * (clip(axis, k) + clip(3, k));
  return row;
}

std::array<double, 4> rowOf(const Mat4& m, int axis) {
  return {m(axis, 0), m(axis, 1), m(axis, 2), m(axis, 3)};
}

}  // namespace

/// A clip depth d is p23 / w - p22 in a perspective with a third row (0, 0, p22, p23).
std::optional<ViewGeometry> ViewGeometry::of(const Mat4& projection, const Mat4& view, std::uint32_t width,
                                             std::uint32_t height) {
  const Mat4& p = projection;
  const Mat4 clip = p * view;
  if (!clip.allFinite()) return {};
  ViewGeometry g;
  g.width = static_cast<int>(width);
  g.height = static_cast<int>(height);
  g.rows[0] = pixelRow(clip, 0, width);
  g.rows[1] = pixelRow(clip, 1, height);
  const bool level = p(3, 0) == 0 && p(3, 1) == 0;
  if (level && p(2, 0) == 0 && p(2, 1) == 0 && p(3, 2) == -1 && p(3, 3) == 0 && p(2, 3) > 0) {
    g.rows[2] = rowOf(clip, 3);
    g.mostDepth = static_cast<float>((1 + p(2, 2)) / p(2, 3)),
    g.farDepth = static_cast<float>(p(2, 2) / p(2, 3));
    return g;
  }
  if (!level || p(3, 2) != 0 || p(3, 3) != 1) return {};
  g.parallel = true;
  g.rows[2] = rowOf(clip, 2);
  g.leastDepth = kBeforeEverything;
  g.mostDepth = 1;
  g.farDepth = 0;
  return g;
}

PixelMatrix ViewGeometry::placing(const std::array<float, 12>& model) const {
  PixelMatrix m;
  float* to[] = {m.x, m.y, m.w};
  for (std::size_t row = 0; row < 3; ++row)
    for (std::size_t k = 0; k < 4; ++k) {
      double sum = k == 3 ? rows[row][3] : 0;
      for (std::size_t i = 0; i < 3; ++i) sum += rows[row][i] * static_cast<double>(model[4 * i + k]);
      to[row][k] = static_cast<float>(sum);
    }
  return m;
}

}  // namespace stadion
