#include "engine/display/output.h"

#include <cmath>

namespace stadion {
namespace {

constexpr double kLeastArea = 1e-4;  ///< of a triangle of three corners, twice

double area(const Vec2& a, const Vec2& b, const Vec2& c) {
  return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

Mat3 about(double xx, double xy, double x0, double yx, double yy, double y0) {
  Mat3 m;
  m << xx, xy, x0, yx, yy, y0, 0, 0, 1;
  return m;
}

/// Output to picture of a picture that was turned clockwise.
Mat3 turnedBack(std::uint32_t degrees) {
  switch (degrees) {
  case 90: return about(0, 1, 0, -1, 0, 1);
  case 180: return about(-1, 0, 1, 0, -1, 1);
  case 270: return about(0, -1, 1, 1, 0, 0);
  default: return Mat3::Identity();
  }
}

}  // namespace

// Heckbert, "Fundamentals of Texture Mapping and Image Warping" (1989), section 2.2.3.
std::optional<Mat3> squareToQuad(const std::array<Vec2, 4>& q) {
  // Convex and clockwise on the screen (y down), so nothing is shown twice or from behind.
  for (std::size_t i = 0; i < 4; ++i)
    if (!(area(q[i], q[(i + 1) % 4], q[(i + 2) % 4]) > kLeastArea)) return std::nullopt;
  const Vec2 d1 = q[1] - q[2], d2 = q[3] - q[2], s = q[0] - q[1] + q[2] - q[3];
  const double det = d1.x() * d2.y() - d2.x() * d1.y();
  const double g = (s.x() * d2.y() - d2.x() * s.y()) / det, h = (d1.x() * s.y() - s.x() * d1.y()) / det;
  Mat3 m;
  m << q[1].x() - q[0].x() + g * q[1].x(), q[3].x() - q[0].x() + h * q[3].x(), q[0].x(),  //
      q[1].y() - q[0].y() + g * q[1].y(), q[3].y() - q[0].y() + h * q[3].y(), q[0].y(),   //
      g, h, 1;
  return m;
}

Mat3 pictureFromOutput(const OutputShape& shape) {
  Mat3 m = about(shape.flipH ? -1 : 1, 0, shape.flipH ? 1 : 0, 0, shape.flipV ? -1 : 1, shape.flipV ? 1 : 0) *
           turnedBack(shape.rotate);
  if (shape.warp)
    if (const auto quad = squareToQuad(*shape.warp)) m = m * quad->inverse();
  return m;
}

}  // namespace stadion
