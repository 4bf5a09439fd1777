#include "pipeline/surface/mask_levels.h"

#include "engine/maths/srgb.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

namespace stadion {
namespace {

/// Linear or as stored, and alpha, not scaled.
struct MaskTexels {
  std::uint32_t width = 0, height = 0;
  std::vector<std::array<float, 4>> texels;
};

float valueOf(std::uint8_t stored, Look look) {
  const double c = stored / 255.0;
  return static_cast<float>(look == Look::Full ? linearFromSrgb(c) : c);
}

/// From 16 bits of linear light.
std::vector<std::uint8_t> tableOfStored() {
  std::vector<std::uint8_t> table(65536);
  for (std::size_t i = 0; i < table.size(); ++i)
    table[i] = static_cast<std::uint8_t>(std::lround(255 * srgbFromLinear(static_cast<double>(i) / 65535)));
  return table;
}

std::uint8_t stored(float value, Look look) {
  static const std::vector<std::uint8_t> table = tableOfStored();
  const float c = std::clamp(value, 0.0f, 1.0f);
  return look == Look::Full ? table[static_cast<std::size_t>(65535 * c + 0.5f)]
                            : static_cast<std::uint8_t>(255 * c + 0.5f);
}

MaskTexels texelsOf(const Texture& texture, Look look) {
  std::array<float, 256> values;
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = valueOf(static_cast<std::uint8_t>(i), look);
  MaskTexels out{texture.width, texture.height, {}};
  out.texels.reserve(texture.rgba.size() / 4);
  for (std::size_t i = 0; i + 3 < texture.rgba.size(); i += 4)
    out.texels.push_back({values[texture.rgba[i]], values[texture.rgba[i + 1]], values[texture.rgba[i + 2]],
                          static_cast<float>(texture.rgba[i + 3]) / 255});
  return out;
}

/// What of the larger picture a texel of the smaller one covers: from, to.
std::array<std::uint32_t, 2> covered(std::uint32_t at, std::uint32_t smaller, std::uint32_t larger) {
  return {at * larger / smaller, ((at + 1) * larger + smaller - 1) / smaller};
}

/// What is not there has no colour; where nothing is, the plain mean stands, in case it is asked for.
std::array<float, 4> meanOf(const MaskTexels& of, std::array<std::uint32_t, 2> columns,
                            std::array<std::uint32_t, 2> rows) {
  std::array<float, 3> plain{}, weighed{};
  float alpha = 0, count = 0;
  for (std::uint32_t y = rows[0]; y < rows[1]; ++y)
    for (std::uint32_t x = columns[0]; x < columns[1]; ++x) {
      const auto& t = of.texels[std::size_t{y} * of.width + x];
      for (std::size_t k = 0; k < 3; ++k) {
        plain[k] += t[k];
        weighed[k] += t[3] * t[k];
      }
      alpha += t[3];
      count += 1;
    }
  const auto& colour = alpha > 0 ? weighed : plain;
  const float of1 = 1 / (alpha > 0 ? alpha : count);
  return {of1 * colour[0], of1 * colour[1], of1 * colour[2], alpha / count};
}

MaskTexels halved(const MaskTexels& of) {
  MaskTexels out{std::max(of.width / 2, 1u), std::max(of.height / 2, 1u), {}};
  for (std::uint32_t y = 0; y < out.height; ++y)
    for (std::uint32_t x = 0; x < out.width; ++x)
      out.texels.push_back(meanOf(of, covered(x, out.width, of.width), covered(y, out.height, of.height)));
  return out;
}

/// The part that is there, if alphas are multiplied by `scale`.
double partThere(const MaskTexels& of, float cutoff, float scale) {
  const auto there = std::ranges::count_if(of.texels, [&](const auto& t) { return t[3] * scale >= cutoff; });
  return static_cast<double>(there) / static_cast<double>(of.texels.size());
}

/// By what the level's alphas are to be multiplied; 0 if nothing serves.
float scaleFor(const MaskTexels& level, float cutoff, double wanted) {
  constexpr double kAlike = 0.05;
  std::vector<float> alphas;
  for (const auto& t : level.texels) alphas.push_back(t[3]);
  const auto count = std::lround(wanted * static_cast<double>(alphas.size()));
  if (count == 0) return wanted < kAlike ? 1.0f : 0.0f;
  std::nth_element(alphas.begin(), alphas.begin() + count - 1, alphas.end(), std::greater());
  const float last = alphas[static_cast<std::size_t>(count - 1)];
  if (!(last > 0)) return 0;
  // Between the last that is to be there and the first that is not, so that filtering keeps the edge.
  const float next =
      alphas.begin() + count == alphas.end() ? 0 : *std::max_element(alphas.begin() + count, alphas.end());
  const float scale = cutoff / (last > next ? 0.5f * (last + next) : last) * 1.0001f;
  return std::abs(partThere(level, cutoff, scale) - wanted) < kAlike ? scale : 0;
}

Texture textureOf(const MaskTexels& level, float scale, Look look) {
  Texture out{level.width, level.height, {}, {}};
  out.rgba.reserve(4 * level.texels.size());
  for (const auto& t : level.texels) {
    for (std::size_t k = 0; k < 3; ++k) out.rgba.push_back(stored(t[k], look));
    out.rgba.push_back(static_cast<std::uint8_t>(std::lround(255 * std::clamp(scale * t[3], 0.0f, 1.0f))));
  }
  return out;
}

}  // namespace

std::vector<Texture> maskLevels(const Texture& texture, float alphaCutoff, Look look) {
  std::vector<Texture> levels;
  MaskTexels level = texelsOf(texture, look);
  const double wanted = partThere(level, alphaCutoff, 1);
  while (level.width > 1 || level.height > 1) {
    level = halved(level);
    const float scale = scaleFor(level, alphaCutoff, wanted);
    if (!(scale > 0)) break;
    levels.push_back(textureOf(level, scale, look));
  }
  return levels;
}

}  // namespace stadion
