#include "engine/environment/mirrored_light.h"

#include "engine/maths/functions.h"

#include <cmath>
#include <numbers>

namespace stadion {
namespace {

/// The bits of i behind the point, turned around (van der Corput).
double mirroredBits(std::uint32_t i) {
  double value = 0;
  for (double part = 0.5; i != 0; i >>= 1, part *= 0.5) value += (i & 1) * part;
  return value;
}

}  // namespace

std::vector<MirroredRay> mirroredRays(double roughness, std::uint32_t count) {
  const double spread = roughness * roughness, squared = spread * spread;
  std::vector<MirroredRay> rays;
  double sum = 0;
  for (std::uint32_t i = 0; i < count; ++i) {
    const double share = (i + 0.5) / count;
    const double cosine = std::sqrt((1 - share) / (1 + (squared - 1) * share));
    const double sine = std::sqrt(1 - cosine * cosine);
    const auto turn = det::sincos(2 * std::numbers::pi * mirroredBits(i));
    // The mirrored direction of +Z about the half vector.
    const double up = 2 * cosine * cosine - 1;
    if (up <= 0) continue;
    const double lobe = (squared - 1) * cosine * cosine + 1;
    const double density = squared / (std::numbers::pi * lobe * lobe) / 4;
    rays.push_back(
        {{2 * cosine * sine * turn.cos, 2 * cosine * sine * turn.sin, up}, up, 1 / (count * density)});
    sum += up;
  }
  for (MirroredRay& ray : rays) ray.weight /= sum;
  return rays;
}

double mirroredWeight(double roughness, double cosine) {
  if (cosine <= 0) return 0;
  const double spread = roughness * roughness;
  const double half = 0.5 * (1 + cosine);  // the square of the half vector's cosine
  const double lobe = half * (spread * spread - 1) + 1;
  return cosine / (lobe * lobe);
}

/// Duff et al. 2017, "Building an Orthonormal Basis, Revisited".
std::array<std::array<double, 3>, 2> axesAround(const std::array<double, 3>& n) {
  const double sign = n[2] < 0 ? -1 : 1, a = -1 / (sign + n[2]), b = n[0] * n[1] * a;
  return {{{1 + sign * n[0] * n[0] * a, sign * b, -sign * n[0]}, {b, sign + n[1] * n[1] * a, -n[1]}}};
}

}  // namespace stadion
