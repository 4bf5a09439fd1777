#include "pipeline/cpu_draw/picture_bands.h"

#include "engine/maths/srgb.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace stadion {
namespace {

constexpr int kEncodedSteps = 16383;

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

/// A value that is not a number becomes 0.
float withinOne(float c) {
  return c > 0 ? std::min(c, 1.0f) : 0.0f;
}

}  // namespace

void PictureBand::draw(const PictureShading& picture, std::size_t band) {
  const SurfaceBlocks blocks(*picture.setup, picture.rung.look, *picture.scene, *picture.view);
  visible_.draw(picture, band, blocks);
  colours_.shade(picture, visible_, blocks);
  encode(picture, layers_.shade(picture, band, visible_, blocks));
}

void PictureBand::encode(const PictureShading& picture, bool layered) {
  const auto& steps = encodedSteps();
  const bool stored = picture.rung.look == Look::Plain;
  const auto byte = [&](float c) {
    const float within = withinOne(c);
    return stored ? static_cast<std::uint8_t>(255 * within + 0.5f)
                  : steps[static_cast<std::size_t>(kEncodedSteps * within + 0.5f)];
  };
  const auto width = static_cast<std::size_t>(picture.width());
  std::size_t at = 0;
  for (int y = visible_.low(); y < visible_.end(); ++y) {
    const unsigned* shown = visible_.row(y);
    const auto fromTop = static_cast<std::size_t>(picture.setup->geometry().height - 1 - y);
    std::uint8_t* out = picture.rgba.data() + 4 * width * fromTop;
    for (std::size_t x = 0; x < width; ++x, ++at, shown += picture.rung.samples, out += 4) {
      const Colour3 c = layered && layers_.has(at) ? layers_.over(at, colours_, picture.rung.samples, shown)
                                                   : colours_.mean(at);
      for (std::size_t k = 0; k < 3; ++k) out[k] = byte(c[k]);
      out[3] = 255;
    }
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
