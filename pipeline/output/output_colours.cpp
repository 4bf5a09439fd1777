#include "pipeline/output/output_colours.h"

#include "engine/maths/srgb.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace stadion {
namespace {

constexpr double kDisplayGamma = 2.2;  ///< of the light that a value of an sRGB picture stands for, nearly
constexpr std::array<double, 3> kLuminance{0.2126, 0.7152, 0.0722};

}  // namespace

double channelGain(double brightness) {
  return std::pow(brightness, 1 / kDisplayGamma);
}

OutputColours::OutputColours(const OutputShape& shape) : changes_(shape.turnsColours()) {
  for (std::size_t c = 0; c < channels_.size(); ++c)
    for (std::size_t v = 0; v < channels_[c].size(); ++v) {
      const double share =
          std::pow(static_cast<double>(v) / 255, 1 / shape.gamma[c]) * channelGain(shape.brightness[c]);
      channels_[c][v] = static_cast<std::uint8_t>(std::lround(255 * std::clamp(share, 0.0, 1.0)));
    }
}

AnaglyphRed::AnaglyphRed(const OutputShape& shape) {
  for (std::size_t c = 0; c < lights_.size(); ++c)
    for (std::size_t v = 0; v < lights_[c].size(); ++v)
      lights_[c][v] = static_cast<std::uint32_t>(
          std::lround(kLuminance[c] * linearFromSrgb(static_cast<double>(v) / 255) * kFull));
  const double gain = channelGain(shape.brightness[0]);
  for (std::size_t v = 1; v < least_.size(); ++v) {
    const double value = (static_cast<double>(v) - 0.5) / 255 / gain;
    const double encoded = std::pow(value, shape.gamma[0]);
    least_[v] = encoded > 1 ? std::numeric_limits<std::uint32_t>::max()
                            : static_cast<std::uint32_t>(std::lround(linearFromSrgb(encoded) * kFull));
  }
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < first_.size(); ++i) {
    while (value < 255 && i << kShift >= least_[value + 1]) ++value;
    first_[i] = static_cast<std::uint8_t>(value);
  }
}

}  // namespace stadion
