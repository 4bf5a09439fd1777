#include "assets/generator/craft/geometry.h"

namespace stadion::assets {
namespace {

double atCorner(std::int64_t x, std::int64_t y, std::int64_t z) {
  auto h = static_cast<std::uint64_t>(x) * 0x9e3779b97f4a7c15ull ^
           static_cast<std::uint64_t>(y) * 0xc2b2ae3d27d4eb4full ^
           static_cast<std::uint64_t>(z) * 0x165667b19e3779f9ull;
  h = (h ^ h >> 29) * 0xbf58476d1ce4e5b9ull;
  h = (h ^ h >> 32) * 0x94d049bb133111ebull;
  return static_cast<double>(h >> 11) * 0x1p-53;
}

}  // namespace

double noise(Point p) {
  const double fx = std::floor(p.x), fy = std::floor(p.y), fz = std::floor(p.z);
  const auto x = static_cast<std::int64_t>(fx), y = static_cast<std::int64_t>(fy),
             z = static_cast<std::int64_t>(fz);
  const double u = smoothstep(0, 1, p.x - fx), v = smoothstep(0, 1, p.y - fy), w = smoothstep(0, 1, p.z - fz);
  double plane[2];
  for (int k = 0; k < 2; ++k)
    plane[k] = mix(mix(atCorner(x, y, z + k), atCorner(x + 1, y, z + k), u),
                   mix(atCorner(x, y + 1, z + k), atCorner(x + 1, y + 1, z + k), u), v);
  return mix(plane[0], plane[1], w);
}

double roughNoise(Point p, int octaves) {
  double sum = 0, whole = 0, strength = 1;
  for (int i = 0; i < octaves; ++i) {
    sum += strength * noise(p), whole += strength;
    p = 2.03 * p + Point{17.3, 5.1, 9.7}, strength *= 0.5;
  }
  return sum / whole;
}

}  // namespace stadion::assets
