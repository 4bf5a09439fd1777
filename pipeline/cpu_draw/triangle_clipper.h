#pragma once
/// Sets up triangles that the kernels leave unfinished: those that cross the near plane, and those that reach
/// far beyond the picture.
///
/// Method   clips in double precision at the near plane and at a margin around the picture, and cuts what
///          is left into triangles. All of them have the depth of the whole one.
/// Threads  pure.

#include "pipeline/cpu_draw/kernels/kernel_data.h"

#include <array>
#include <optional>
#include <vector>

namespace stadion {

class TriangleClipper {
public:
  TriangleClipper(const SetupParameters& by, bool parallel) : by_(by), parallel_(parallel) {}

  /// Appends what is seen of the triangle with these corners in mesh coordinates. If corners are not
  /// finite: nothing. `grow`: overlaps its neighbours by 1/256 pixel instead of leaving a gap by rounding.
  void clip(const std::array<std::array<float, 3>, 3>& corners, const PixelMatrix& matrix, unsigned triangle,
            bool grow, std::vector<TriangleRecord>& out) const;

private:
  /// x * w, y * w and w, or in a parallel projection x, y and depth.
  using Corner = std::array<double, 3>;
  class Polygon;
  /// Depth in the picture: x * right + y * up + at.
  struct Plane {
    double right, up, at;
  };
  bool isOutside(const std::array<Corner, 3>& corners) const;
  Polygon clipped(const std::array<Corner, 3>& corners) const;
  template <class Work>
  void forEachBorder(const Work& work) const;
  std::optional<Plane> planeOf(const std::array<Corner, 3>& corners) const;
  void emit(const std::array<std::array<double, 2>, 3>& at, const Plane& plane, float most, unsigned triangle,
            unsigned flags, std::vector<TriangleRecord>& out) const;

  SetupParameters by_;
  bool parallel_;
};

}  // namespace stadion
