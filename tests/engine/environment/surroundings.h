#pragma once
/// Pictures of surroundings for tests.

#include "engine/environment/radiance_map.h"

#include <functional>

namespace stadion::test {

using ColourAt = std::function<std::array<double, 3>(const std::array<double, 3>&)>;

/// `colour`: of a direction.
inline RadianceMap surroundingsOf(std::uint32_t height, const ColourAt& colour) {
  RadianceMap map{2 * height, height, {}};
  for (std::uint32_t y = 0; y < height; ++y)
    for (std::uint32_t x = 0; x < map.width; ++x) {
      const auto c = colour(equirectangularDirection((x + 0.5) / map.width, (y + 0.5) / height));
      map.pixels.push_back({static_cast<float>(c[0]), static_cast<float>(c[1]), static_cast<float>(c[2])});
    }
  return map;
}

/// A dim hall with a bright window to the front right and a coloured floor.
inline std::array<double, 3> hallAt(const std::array<double, 3>& d) {
  const double window = 0.6 * d[0] + 0.7 * d[1] + 0.38 * d[2];
  if (window > 0.93) return {6, 5.5, 4};
  if (d[2] < -0.2) return {0.35, 0.2, 0.1};
  return {0.3 + 0.1 * d[0], 0.3, 0.35 + 0.15 * d[2]};
}

inline RadianceMap whiteSurroundings() {
  return surroundingsOf(64, [](const auto&) { return std::array<double, 3>{1, 1, 1}; });
}

}  // namespace stadion::test
