#include "engine/environment/environment_light.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace stadion {
namespace {

constexpr int kMantissa = 9, kBias = 15, kMostExponent = 31;
constexpr float kMostLight = 65408;  ///< 511 / 512 * 2^16

/// 2 to the e.
float floatPowerOfTwo(int e) {
  return std::bit_cast<float>(static_cast<std::uint32_t>(e + 127) << 23);
}

}  // namespace

std::uint32_t packedLight(const Radiance& light) {
  Radiance c;
  std::ranges::transform(light, c.begin(), [](float x) { return x > 0 ? std::min(x, kMostLight) : 0.0f; });
  const float most = std::max({c[0], c[1], c[2]});
  // The exponent of the brightest colour; rounding may need one more.
  int exponent = std::max(static_cast<int>(std::bit_cast<std::uint32_t>(most) >> 23) - 127, -kBias - 1) + 1;
  const auto rounded = [&](float x) {
    return static_cast<std::uint32_t>(x * floatPowerOfTwo(kMantissa - exponent) + 0.5f);
  };
  if (rounded(most) > 511) ++exponent;
  const auto stored = static_cast<std::uint32_t>(std::min(exponent + kBias, kMostExponent));
  return rounded(c[0]) | rounded(c[1]) << 9 | rounded(c[2]) << 18 | stored << 27;
}

Radiance unpackedLight(std::uint32_t texel) {
  const float scale = floatPowerOfTwo(static_cast<int>(texel >> 27) - kBias - kMantissa);
  return {static_cast<float>(texel & 511) * scale, static_cast<float>(texel >> 9 & 511) * scale,
          static_cast<float>(texel >> 18 & 511) * scale};
}

std::array<double, 3> octahedralDirection(double x, double y) {
  const double z = 1 - std::abs(x) - std::abs(y);
  if (z < 0) {
    const double folded = (1 - std::abs(y)) * (x < 0 ? -1 : 1);
    y = (1 - std::abs(x)) * (y < 0 ? -1 : 1);
    x = folded;
  }
  const double per = 1 / std::sqrt(x * x + y * y + z * z);
  return {x * per, y * per, z * per};
}

std::array<double, 2> octahedralPlace(const std::array<double, 3>& d) {
  const double per = 1 / (std::abs(d[0]) + std::abs(d[1]) + std::abs(d[2]));
  const double x = d[0] * per, y = d[1] * per;
  if (d[2] >= 0) return {x, y};
  return {(1 - std::abs(y)) * (x < 0 ? -1 : 1), (1 - std::abs(x)) * (y < 0 ? -1 : 1)};
}

std::array<double, 9> harmonicsAt(const std::array<double, 3>& d) {
  const double x = d[0], y = d[1], z = d[2];
  return {0.28209479177387814,
          0.4886025119029199 * y,
          0.4886025119029199 * z,
          0.4886025119029199 * x,
          1.0925484305920792 * x * y,
          1.0925484305920792 * y * z,
          0.31539156525252005 * (3 * z * z - 1),
          1.0925484305920792 * x * z,
          0.5462742152960396 * (x * x - y * y)};
}

Radiance EnvironmentLight::matt(const std::array<float, 3>& n) const {
  const std::array<double, 9> y = harmonicsAt({n[0], n[1], n[2]});
  Radiance sum{};
  for (std::size_t c = 0; c < 3; ++c) {
    double light = 0;
    for (std::size_t i = 0; i < y.size(); ++i) light += y[i] * double{harmonics[i][c]};
    sum[c] = static_cast<float>(light);
  }
  return sum;
}

bool EnvironmentLight::isSound() const {
  const bool power = pictureSide == 0 || (std::has_single_bit(pictureSide) && pictureSide >= kLeastPicture &&
                                          pictureSide <= kMostPicture);
  if (!power || texels.size() != sizeWith(pictureSide)) return false;
  constexpr float kMost = 1e8f;
  return std::ranges::all_of(harmonics, [](const Radiance& c) {
    return std::ranges::all_of(c, [](float x) { return x >= -kMost && x <= kMost; });
  });
}

}  // namespace stadion
