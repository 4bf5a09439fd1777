#pragma once
/// Which of a wall's views can see a sphere, among those that the wall as a whole may see (room_cull.h).
///
/// A view does not see a sphere that is wholly outside one of the four sides of its frustum; nor, where one
/// sample is taken a pixel, one whose outline lies between the middles of pixels: OpenGL makes fragments only
/// for pixels whose middles are inside of a triangle (OpenGL 3.3 core, 3.6.1). Pictures are the same without
/// it.
///
/// Safe      single precision: an object counts as seen unless it is unseen by more than rounding.
/// Frames    spheres are in World axes relative to the list's origin [m].
/// Threads   plain values.

#include "pipeline/draw_list/draw_list.h"

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

namespace stadion {

class EyeTest {
public:
  /// For the list's views. `oneSample`: pictures of width x height pixels with one sample each; else what is
  /// small is seen, too.
  EyeTest(const DrawList& list, bool oneSample, std::uint32_t width, std::uint32_t height);

  /// Bit v: the list's view number v.
  std::uint8_t viewsThatSee(const std::array<float, 3>& centre, float radius) const {
    const float reach = radius + kRounding * (size(centre[0]) + size(centre[1]) + size(centre[2]) + radius);
    std::uint8_t seen = 0;
    for (std::uint32_t view = 0; view < count_; ++view)
      if (sides_[view].mayTouch(centre, reach)) seen |= static_cast<std::uint8_t>(1u << view);
    if (smallFrom_ == 0 || seen == 0) return seen;
    return withoutThoseBetweenPixels(seen, centre, reach);
  }

private:
  static constexpr float kRounding = 4e-6f;  ///< rounding error of single precision, a few times over
  typedef float FourFloats __attribute__((vector_size(16)));

  /// The sides of a view's frustum: inside is x px + y py + z pz + offset >= 0.
  struct Sides {
    FourFloats x, y, z, offset;

    bool mayTouch(const std::array<float, 3>& c, float reach) const {
      const FourFloats inside = x * c[0] + (y * c[1] + (z * c[2] + offset)) + reach;
      const auto outside = std::bit_cast<std::array<std::uint64_t, 2>>(inside < 0.0f);
      return (outside[0] | outside[1]) == 0;
    }
  };
  struct Lens {
    std::array<float, 12> view;              ///< (3 x 4), row major: to eye coordinates
    std::array<double, 2> scale{}, shift{};  ///< pixels: scale x / depth + shift
  };

  static float size(float x) { return std::fabs(x); }
  std::uint8_t withoutThoseBetweenPixels(std::uint8_t seen, const std::array<float, 3>& centre,
                                         float radius) const;
  bool coversAMiddle(const Lens& lens, const std::array<float, 3>& centre, float radius) const;

  std::uint32_t count_ = 0;
  static_assert(DrawList::kMostViews <= 8, "a byte has a bit for each view");
  std::array<Sides, DrawList::kMostViews> sides_;
  std::array<Lens, DrawList::kMostViews> lenses_;
  /// Ratio of radius and depth from which an object is at least a pixel wide. 0 = no object is left out.
  float smallFrom_ = 0;
};

}  // namespace stadion
