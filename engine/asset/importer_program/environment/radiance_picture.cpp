#include "engine/asset/importer_program/environment/radiance_picture.h"

#include "engine/asset/importer_program/source/source_scene.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace stadion::importer {
namespace {

constexpr float kMostRadiance = 1e6f;  ///< so that no sum overflows

}  // namespace

void checkRadianceSize(std::int64_t width, std::int64_t height) {
  if (width < 2 || width > kMostRadianceColumns || height > kMostRadianceColumns / 2)
    throw Refusal(fmt::format("is {} x {} pixels large; surroundings have 2 x 1 to {} x {}", width, height,
                              kMostRadianceColumns, kMostRadianceColumns / 2));
  if (width != 2 * height)
    throw Refusal(fmt::format("is {} x {} pixels large; a picture of surroundings (equirectangular) is twice "
                              "as wide as high",
                              width, height));
}

void checkRadiance(RadianceMap& map) {
  for (std::size_t i = 0; i < map.pixels.size(); ++i)
    for (float& colour : map.pixels[i]) {
      if (!std::isfinite(colour))
        throw Refusal(fmt::format("has no finite number at pixel {}, {}", i % map.width, i / map.width));
      colour = colour > 0 ? std::min(colour, kMostRadiance) : 0;
    }
}

}  // namespace stadion::importer
