#include "pipeline/picture/linear_light.h"

#include "engine/maths/srgb.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace stadion {
namespace {

std::array<std::uint32_t, 256> makeTable() {
  std::array<std::uint32_t, 256> table{};
  for (std::size_t i = 0; i < table.size(); ++i) {
    const double c = static_cast<double>(i) / 255;
    table[i] = static_cast<std::uint32_t>(std::lround(linearFromSrgb(c) * kFullLight));
  }
  return table;
}

const std::array<std::uint32_t, 256>& table() {
  static const std::array<std::uint32_t, 256> kTable = makeTable();
  return kTable;
}

}  // namespace

std::uint32_t linearFromSrgb(std::uint8_t byte) {
  return table()[byte];
}

std::uint8_t srgbFromLinear(std::uint32_t light) {
  const auto& t = table();
  light = std::min(light, kFullLight);
  const auto above = std::lower_bound(t.begin(), t.end(), light);
  if (above == t.begin()) return 0;
  const auto below = above - 1;
  const auto nearest = *above - light < light - *below ? above : below;
  return static_cast<std::uint8_t>(nearest - t.begin());
}

}  // namespace stadion
