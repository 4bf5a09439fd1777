#include "pipeline/cpu_draw/picture_bands.h"

#include "engine/maths/srgb.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace stadion {
namespace {

/// Linear light in steps, to sRGB.
const std::array<std::uint8_t, kEncodedSteps + 1>& encodedSteps() {
  static const auto table = [] {
    std::array<std::uint8_t, kEncodedSteps + 1> made{};
    for (std::size_t i = 0; i < made.size(); ++i)
      made[i] = static_cast<std::uint8_t>(
          std::lround(255 * srgbFromLinear(static_cast<double>(i) / kEncodedSteps)));
    return made;
  }();
  return table;
}

}  // namespace

void PictureBand::draw(const PictureShading& picture, std::size_t band) {
  const SurfaceBlocks blocks(*picture.kernels, *picture.setup, picture.rung.look, *picture.scene,
                             *picture.view);
  visible_.draw(picture, band, blocks);
  colours_.shade(picture, visible_, blocks);
  if (layers_.shade(picture, band, visible_, blocks)) layers_.blend(picture, visible_, colours_);
  if (!picture.surfacesOnly) encode(picture);
}

void PictureBand::encode(const PictureShading& picture) {
  const std::uint8_t* steps = picture.rung.look == Look::Plain ? nullptr : encodedSteps().data();
  const auto width = static_cast<std::size_t>(picture.width());
  for (int y = visible_.low(); y < visible_.end(); ++y) {
    const auto fromTop = static_cast<std::size_t>(picture.setup->geometry().height - 1 - y);
    picture.kernels->encode(colours_.at(y - visible_.low(), 0), static_cast<unsigned>(width), steps,
                            picture.rgba.data() + 4 * width * fromTop);
  }
}

void BandMemory::draw(const PictureShading& picture, std::size_t band) {
  std::unique_ptr<PictureBand> memory = take();
  memory->draw(picture, band);
  giveBack(std::move(memory));
}

std::unique_ptr<PictureBand> BandMemory::take() {
  const std::lock_guard lock(mutex_);
  if (free_.empty()) return std::make_unique<PictureBand>();
  auto band = std::move(free_.back());
  free_.pop_back();
  return band;
}

void BandMemory::giveBack(std::unique_ptr<PictureBand> band) {
  const std::lock_guard lock(mutex_);
  free_.push_back(std::move(band));
}

}  // namespace stadion
