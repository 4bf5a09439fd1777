#pragma once
/// A plain drawing of triangles, one sample at a time in double precision, which the kernels are compared
/// with.

#include <array>
#include <cmath>
#include <vector>

namespace stadion::test {

struct ScalarCorner {
  double x, y, depth;  ///< [pixels]
};
using ScalarTriangle = std::array<ScalarCorner, 3>;

/// Places of the samples of a pixel.
inline std::vector<std::array<double, 2>> samplePlaces(int samples) {
  if (samples == 1) return {{0.5, 0.5}};
  if (samples == 2) return {{0.25, 0.75}, {0.75, 0.25}};
  if (samples == 4) return {{0.375, 0.125}, {0.875, 0.375}, {0.125, 0.625}, {0.625, 0.875}};
  std::vector<std::array<double, 2>> places;
  for (const auto& p : {std::array{9, 5}, {7, 11}, {13, 9}, {5, 3}, {3, 13}, {1, 7}, {11, 15}, {15, 1}})
    places.push_back({p[0] / 16.0, p[1] / 16.0});
  return places;
}

inline double doubleArea(const ScalarTriangle& t) {
  return (t[1].x - t[0].x) * (t[2].y - t[0].y) - (t[1].y - t[0].y) * (t[2].x - t[0].x);
}

/// How far a point lies inside the triangle; negative: outside [pixels].
inline double inside(const ScalarTriangle& t, double x, double y) {
  const double side = doubleArea(t) < 0 ? -1 : 1;
  double least = 1e30;
  for (int k = 0; k < 3; ++k) {
    const ScalarCorner &a = t[k], &b = t[(k + 1) % 3];
    const double dx = b.x - a.x, dy = b.y - a.y, length = std::hypot(dx, dy);
    if (length > 0) least = std::min(least, side * (dx * (y - a.y) - dy * (x - a.x)) / length);
  }
  return least;
}

inline double depthAt(const ScalarTriangle& t, double x, double y) {
  const double area = doubleArea(t);
  double sum = 0;
  for (int k = 0; k < 3; ++k) {
    const ScalarCorner &a = t[(k + 1) % 3], &b = t[(k + 2) % 3];
    sum += t[k].depth * ((b.x - a.x) * (y - a.y) - (b.y - a.y) * (x - a.x)) / area;
  }
  return sum;
}

}  // namespace stadion::test
