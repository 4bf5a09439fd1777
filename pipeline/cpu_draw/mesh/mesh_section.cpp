#include "pipeline/cpu_draw/mesh/mesh_section.h"

#include <algorithm>
#include <cmath>

namespace stadion {
namespace {

using Plane = std::array<double, 4>;

/// Returns true if the plane's function is negative in the whole box, by more than the rounding of vertices,
/// which are placed in single precision.
bool isBeyond(const MeshSection& s, const Plane& plane) {
  constexpr double kRounding = 1e-5;
  double most = plane[3], size = std::fabs(plane[3]);
  for (std::size_t k = 0; k < 3; ++k) {
    const double low = plane[k] * static_cast<double>(s.low[k]),
                 high = plane[k] * static_cast<double>(s.high[k]);
    most += std::max(low, high);
    size += std::max(std::fabs(low), std::fabs(high));
  }
  return most < -kRounding * size;
}

/// a + factor * b
Plane sum(const float* a, double factor, const Plane& b) {
  Plane out;
  for (std::size_t k = 0; k < 4; ++k) out[k] = static_cast<double>(a[k]) + factor * b[k];
  return out;
}

Plane negative(Plane p) {
  for (double& x : p) x = -x;
  return p;
}

}  // namespace

bool mayBeSeen(const MeshSection& section, const PixelMatrix& by, bool parallel, int width, int height) {
  constexpr double kBeside = 1;  // [pixels]
  Plane w{0, 0, 0, 1};
  if (!parallel) {
    w = sum(by.w, 0, w);
    if (isBeyond(section, w)) return false;
  }
  return !isBeyond(section, sum(by.x, kBeside, w)) &&
         !isBeyond(section, negative(sum(by.x, -width - kBeside, w))) &&
         !isBeyond(section, sum(by.y, kBeside, w)) &&
         !isBeyond(section, negative(sum(by.y, -height - kBeside, w)));
}

}  // namespace stadion
