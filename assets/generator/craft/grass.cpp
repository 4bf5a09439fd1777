#include "assets/generator/craft/geometry.h"
#include "assets/generator/craft/models.h"
#include "assets/generator/craft/picture.h"

#include <algorithm>

// Blades of grass, drawn as short strokes of sixteen greens.

namespace stadion::assets {
namespace {

constexpr int kGrassSide = 256;  // pixels
constexpr int kShades = 16;

std::vector<int> draw() {
  std::vector<int> shade(kGrassSide * kGrassSide, 7);
  Dice dice(0);
  const auto at = [&](int x, int y) -> int& {
    return shade[static_cast<std::size_t>((y & 255) * kGrassSide + (x & 255))];
  };
  for (int blade = 0; blade < 14000; ++blade) {
    int x = static_cast<int>(dice.roll(kGrassSide)), y = static_cast<int>(dice.roll(kGrassSide));
    const int base = 4 + static_cast<int>(dice.roll(5) + dice.roll(4)),
              length = 4 + static_cast<int>(dice.roll(6));
    const int lean = static_cast<int>(dice.roll(3)) - 1;
    for (int i = 0; i < length; ++i) {
      at(x, y) = std::clamp(base - 3 + 5 * i / length, 0, kShades - 1);  // dark at the root, light at the tip
      --y;
      if (dice.roll(3) == 0) x += lean;
    }
  }
  return shade;
}

}  // namespace

std::string grassPicture() {
  std::string palette, rows;
  for (int i = 0; i < kShades; ++i) {
    palette.push_back(static_cast<char>(44 + 5 * i));
    palette.push_back(static_cast<char>(92 + 6 * i));
    palette.push_back(static_cast<char>(30 + 3 * i));
  }
  const std::vector<int> shade = draw();
  for (std::size_t y = 0; y < kGrassSide; ++y) {
    rows.push_back(0);
    for (std::size_t x = 0; x < kGrassSide; x += 2)
      rows.push_back(static_cast<char>(shade[y * kGrassSide + x] << 4 | shade[y * kGrassSide + x + 1]));
  }
  return png(kGrassSide, kGrassSide, {4, PngColour::Palette}, palette, rows);
}

}  // namespace stadion::assets
