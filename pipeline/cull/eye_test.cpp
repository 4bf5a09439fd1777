#include "pipeline/cull/eye_test.h"

#include <algorithm>
#include <cmath>

namespace stadion {
namespace {

/// Vertices are snapped to a grid, of 1/16 of a pixel at the coarsest.
constexpr double kSnapping = 1.0 / 8;  // [pixels]

/// Returns true if there is a whole number and a half between the two.
bool holdsAMiddle(double from, double to) {
  return std::floor(to - 0.5) >= std::ceil(from - 0.5);
}

}  // namespace

EyeTest::EyeTest(const DrawList& list, bool oneSample, std::uint32_t width, std::uint32_t height)
    : count_(std::min<std::uint32_t>(list.viewCount, DrawList::kMostViews)) {
  const double pixels[2] = {static_cast<double>(width), static_cast<double>(height)};
  double sharpest = 0;
  for (std::uint32_t view = 0; view < count_; ++view) {
    const DrawView& e = list.views[view];
    const Mat4 clip = e.projection * e.view;
    for (int side = 0; side < 4; ++side) {
      // Inside is w + x >= 0, w - x >= 0, and so for y (Gribb and Hartmann, "Fast Extraction of Viewing
      // Frustum Planes from the World-View-Projection Matrix", 2001).
      const Vec4 plane =
          clip.row(3).transpose() + (side % 2 == 0 ? 1.0 : -1.0) * clip.row(side / 2).transpose();
      const Vec4 unit = plane / plane.head<3>().norm();
      Sides& s = sides_[view];
      s.x[side] = static_cast<float>(unit[0]);
      s.y[side] = static_cast<float>(unit[1]);
      s.z[side] = static_cast<float>(unit[2]);
      s.offset[side] = static_cast<float>(unit[3]);
    }
    Lens& lens = lenses_[view];
    for (int row = 0; row < 3; ++row)
      for (int k = 0; k < 4; ++k)
        lens.view[static_cast<std::size_t>(4 * row + k)] = static_cast<float>(e.view(row, k));
    for (int axis = 0; axis < 2; ++axis) {
      const auto a = static_cast<std::size_t>(axis);
      lens.scale[a] = 0.5 * pixels[a] * e.projection(axis, axis);
      lens.shift[a] = 0.5 * pixels[a] * (1 - e.projection(axis, 2));
      sharpest = std::max(sharpest, lens.scale[a]);
    }
  }
  if (oneSample && sharpest > 0) smallFrom_ = static_cast<float>(0.5 / sharpest);
}

std::uint8_t EyeTest::withoutThoseBetweenPixels(std::uint8_t seen, const std::array<float, 3>& centre,
                                                float radius) const {
  for (std::uint32_t view = 0; view < count_; ++view)
    if ((seen >> view & 1) && !coversAMiddle(lenses_[view], centre, radius))
      seen &= static_cast<std::uint8_t>(~(1u << view));
  return seen;
}

/// The outline's extent along an axis of the picture is between the two planes through the eye that touch the
/// sphere: in the plane of that axis x and the depth w, x / w = (c_x c_w +- r sqrt(c_x^2 + c_w^2 - r^2)) /
/// (c_w^2 - r^2).
bool EyeTest::coversAMiddle(const Lens& lens, const std::array<float, 3>& centre, float radius) const {
  const auto along = [&](std::size_t row) {
    const float* m = &lens.view[4 * row];
    return m[0] * centre[0] + (m[1] * centre[1] + (m[2] * centre[2] + m[3]));
  };
  const float depth = -along(2);
  if (!(depth > 4 * radius) || radius > smallFrom_ * depth) return true;
  const double w = static_cast<double>(depth), r = static_cast<double>(radius);
  for (std::size_t axis = 0; axis < 2; ++axis) {
    const double x = static_cast<double>(along(axis));
    const double half = r * std::sqrt(x * x + w * w - r * r), below = w * w - r * r;
    const double from = lens.scale[axis] * (x * w - half) / below + lens.shift[axis] - kSnapping;
    const double to = lens.scale[axis] * (x * w + half) / below + lens.shift[axis] + kSnapping;
    if (!holdsAMiddle(from, to)) return false;
  }
  return true;
}

}  // namespace stadion
