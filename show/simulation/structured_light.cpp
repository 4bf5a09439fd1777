#include "show/simulation/structured_light.h"

#include "engine/maths/angles.h"
#include "engine/maths/functions.h"
#include "engine/maths/srgb.h"

#include <algorithm>
#include <cmath>

namespace stadion {
namespace {

constexpr std::size_t kColours = 16384;

double third(std::size_t channel) {
  return 2 * kPi / 3 * static_cast<double>(channel);
}

}  // namespace

PhaseColours::PhaseColours() : colours_(kColours) {
  for (std::size_t i = 0; i < kColours; ++i)
    for (std::size_t c = 0; c < 3; ++c) {
      const double phase = 2 * kPi * static_cast<double>(i) / kColours + third(c);
      const double value = 255 * srgbFromLinear(0.5 + 0.5 * det::sin(phase));
      colours_[i][c] = static_cast<std::uint8_t>(std::clamp(std::lround(value), 0L, 255L));
    }
}

const std::array<std::uint8_t, 3>& PhaseColours::of(double turns) const {
  const double part = turns - std::floor(turns);
  return colours_[static_cast<std::size_t>(part * kColours + 0.5) % kColours];
}

void DirectionWave::paint(const SourceView& view, Picture& picture) const {
  forEachDirection(view, picture.width, picture.height, [&](std::uint32_t x, std::uint32_t y, const Vec3& d) {
    const auto& colour = colours_.of(frequency_ * d[axis_]);
    std::uint8_t* pixel = picture.at(x, y);
    pixel[0] = colour[0];
    pixel[1] = colour[1];
    pixel[2] = colour[2];
    pixel[3] = 255;
  });
}

DirectionWave::Reading DirectionWave::read(const Vec3& light, const Vec3& direction) const {
  double sine = 0, cosine = 0;
  for (std::size_t c = 0; c < 3; ++c) {
    sine += light[static_cast<int>(c)] * det::cos(third(c));
    cosine += light[static_cast<int>(c)] * det::sin(third(c));
  }
  double turns = det::atan2(sine, cosine) / (2 * kPi) - frequency_ * direction[axis_];
  turns -= std::round(turns);
  return {turns / frequency_, 2.0 / 3 * 2 * std::sqrt(sine * sine + cosine * cosine)};
}

}  // namespace stadion
