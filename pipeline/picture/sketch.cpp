#include "pipeline/picture/sketch.h"

#include <algorithm>
#include <cmath>

namespace stadion {

void Sketch::line(Vec2 a, Vec2 b, const Colour& colour, int thick) {
  if (!clip(a, b)) return;
  const int steps = static_cast<int>(std::ceil((b - a).cwiseAbs().maxCoeff())) + 1;
  for (int i = 0; i <= steps; ++i) {
    const Vec2 p = a + (b - a) * (static_cast<double>(i) / steps);
    dot(static_cast<int>(std::floor(p.x())), static_cast<int>(std::floor(p.y())), colour, thick);
  }
}

void Sketch::fill(std::uint32_t x, std::uint32_t y, std::uint32_t width, std::uint32_t height,
                  const Colour& colour) {
  for (std::uint32_t v = y; v < std::min(y + height, picture_.height); ++v)
    for (std::uint32_t u = x; u < std::min(x + width, picture_.width); ++u)
      std::copy(colour.begin(), colour.end(), picture_.at(u, v));
}

void Sketch::border(const Colour& colour) {
  const double right = width() - 1, low = height() - 1;
  const Vec2 corners[] = {{0, 0}, {right, 0}, {right, low}, {0, low}};
  for (std::size_t i = 0; i < 4; ++i) line(corners[i], corners[(i + 1) % 4], colour, 1);
}

void Sketch::dot(int x, int y, const Colour& colour, int thick) {
  for (int v = y - thick / 2; v < y - thick / 2 + thick; ++v)
    for (int u = x - thick / 2; u < x - thick / 2 + thick; ++u) {
      if (u < 0 || v < 0 || u >= static_cast<int>(picture_.width) || v >= static_cast<int>(picture_.height))
        continue;
      std::copy(colour.begin(), colour.end(),
                picture_.at(static_cast<std::uint32_t>(u), static_cast<std::uint32_t>(v)));
    }
}

/// Clips the line to the picture (Liang and Barsky 1984). Returns false if nothing is left.
bool Sketch::clip(Vec2& a, Vec2& b) const {
  if (!a.allFinite() || !b.allFinite()) return false;
  const Vec2 d = b - a;
  double from = 0, to = 1;
  const double p[] = {-d.x(), d.x(), -d.y(), d.y()};
  const double q[] = {a.x(), width() - a.x(), a.y(), height() - a.y()};
  for (std::size_t i = 0; i < 4; ++i) {
    if (p[i] == 0 && q[i] < 0) return false;
    if (p[i] < 0) from = std::max(from, q[i] / p[i]);
    if (p[i] > 0) to = std::min(to, q[i] / p[i]);
  }
  if (from > to) return false;
  b = a + to * d;
  a = a + from * d;
  return true;
}

}  // namespace stadion
