#include "pipeline/cpu_draw/mesh/cpu_texture.h"

#include "engine/maths/srgb.h"
#include "pipeline/surface/mask_levels.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace stadion {

/// Linear light in the full look.
struct CpuTexture::Linear {
  std::uint32_t width, height;
  std::vector<std::array<float, 4>> texels;

  Linear(std::uint32_t w, std::uint32_t h) : width(w), height(h), texels(std::size_t{w} * h) {}
  Linear(const Texture& t, Look look) : Linear(t.width, t.height) {
    std::array<float, 256> values;
    for (std::size_t i = 0; i < values.size(); ++i) {
      const double c = static_cast<double>(i) / 255;
      values[i] = static_cast<float>(look == Look::Full ? linearFromSrgb(c) : c);
    }
    for (std::size_t i = 0; i < texels.size(); ++i)
      texels[i] = {values[t.rgba[4 * i]], values[t.rgba[4 * i + 1]], values[t.rgba[4 * i + 2]],
                   static_cast<float>(t.rgba[4 * i + 3]) / 255};
  }
  const std::array<float, 4>& at(std::uint32_t x, std::uint32_t y) const {
    return texels[std::size_t{std::min(y, height - 1)} * width + std::min(x, width - 1)];
  }
  Linear halved() const {
    Linear half(std::max(width / 2, 1u), std::max(height / 2, 1u));
    for (std::uint32_t y = 0; y < half.height; ++y)
      for (std::uint32_t x = 0; x < half.width; ++x)
        for (std::size_t k = 0; k < 4; ++k)
          half.texels[std::size_t{y} * half.width + x][k] =
              0.25f * (at(2 * x, 2 * y)[k] + at(2 * x + 1, 2 * y)[k] + at(2 * x, 2 * y + 1)[k] +
                       at(2 * x + 1, 2 * y + 1)[k]);
    return half;
  }
};

CpuTexture::CpuTexture(const Texture& texture, float alphaCutoff, Look look) {
  const Linear whole(texture, look);
  addLevel(whole, look);
  if (alphaCutoff > 0)
    for (const Texture& level : maskLevels(texture, alphaCutoff, look)) addLevel(Linear(level, look), look);
  else
    addHalves(whole, look);
  texels_.resize(texels_.size() + kKernelPadding);
}

void CpuTexture::addHalves(Linear level, Look look) {
  while (level.width > 1 || level.height > 1) {
    level = level.halved();
    addLevel(level, look);
  }
}

void CpuTexture::addLevel(const Linear& level, Look look) {
  if (levels_.size() == TextureParameters::kMostLevels) return;
  levels_.push_back({level.width, level.height, texels_.size()});
  const auto stored = [&](float c, bool colour) {
    const float root = colour && look == Look::Full ? std::sqrt(c) : c;
    return static_cast<std::uint32_t>(255 * std::clamp(root, 0.0f, 1.0f) + 0.5f);
  };
  for (std::uint32_t y = 0; y < level.height; ++y)
    for (std::uint32_t x = 0; x <= level.width; ++x) {
      const auto& c = level.at(x % level.width, y);
      texels_.push_back(stored(c[0], true) | stored(c[1], true) << 8 | stored(c[2], true) << 16 |
                        stored(c[3], false) << 24);
    }
}

TextureParameters CpuTexture::parameters() const {
  TextureParameters p{};
  p.texels = texels_.data();
  p.levels = static_cast<int>(levels_.size());
  for (std::size_t i = 0; i < levels_.size(); ++i)
    p.width[i] = static_cast<int>(levels_[i].width), p.height[i] = static_cast<int>(levels_[i].height),
    p.first[i] = static_cast<int>(levels_[i].first);
  p.wrapU = p.wrapV = TextureWrap::Repeat;
  p.transform[0] = p.transform[4] = 1;
  return p;
}

}  // namespace stadion
