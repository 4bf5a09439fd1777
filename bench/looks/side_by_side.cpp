#include "bench/looks/side_by_side.h"

#include "pipeline/picture/lettering.h"

#include <algorithm>
#include <cstdint>
#include <cstdlib>

namespace stadion::bench {
namespace {

constexpr std::uint32_t kColumns = 3, kScale = 2, kGap = 4, kCaption = 2 * kLetterHeight;

/// A part of a picture.
struct Crop {
  std::uint32_t x = 0, y = 0, width, height;
};

std::uint64_t differenceIn(const Crop& crop, const Picture& a, const Picture& b) {
  std::uint64_t sum = 0;
  for (std::uint32_t y = crop.y; y < crop.y + crop.height; ++y)
    for (std::uint32_t x = crop.x; x < crop.x + crop.width; ++x)
      for (int c = 0; c < 3; ++c)
        sum += static_cast<std::uint64_t>(std::abs(int{a.at(x, y)[c]} - int{b.at(x, y)[c]}));
  return sum;
}

Crop mostDifferent(const std::vector<LabelledPicture>& pictures) {
  const Picture& reference = pictures.front().picture;
  const std::uint32_t width = std::max(1U, reference.width / 5), height = std::max(1U, reference.height / 5);
  Crop best{0, 0, width, height};
  std::uint64_t most = 0;
  for (std::uint32_t y = 0; y + height <= reference.height; y += std::max(1U, height / 2))
    for (std::uint32_t x = 0; x + width <= reference.width; x += std::max(1U, width / 2)) {
      const Crop crop{x, y, width, height};
      std::uint64_t sum = 0;
      for (const LabelledPicture& p : pictures) sum += differenceIn(crop, p.picture, reference);
      if (sum > most) {
        most = sum;
        best = crop;
      }
    }
  return best;
}

void copyEnlarged(const Picture& from, const Crop& crop, std::uint32_t left, std::uint32_t top, Picture& to) {
  for (std::uint32_t y = 0; y < crop.height * kScale; ++y)
    for (std::uint32_t x = 0; x < crop.width * kScale; ++x)
      std::copy_n(from.at(crop.x + x / kScale, crop.y + y / kScale), 4, to.at(left + x, top + y));
}

}  // namespace

Picture sideBySide(const std::vector<LabelledPicture>& pictures) {
  const Crop crop = mostDifferent(pictures);
  const std::uint32_t cellWidth = crop.width * kScale + kGap,
                      cellHeight = crop.height * kScale + kCaption + kGap;
  const auto count = static_cast<std::uint32_t>(pictures.size());
  Picture sheet(std::min(count, kColumns) * cellWidth, (count + kColumns - 1) / kColumns * cellHeight);
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::uint32_t left = i % kColumns * cellWidth, top = i / kColumns * cellHeight;
    letter(sheet, left + kGap, top + kGap, pictures[i].label, {0, 0, 0});
    copyEnlarged(pictures[i].picture, crop, left, top + kCaption, sheet);
  }
  return sheet;
}

}  // namespace stadion::bench
