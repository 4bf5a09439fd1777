#pragma once
/// What becomes of colours on the way to an output: its gamma and brightness, and the red of an anaglyph.
///
/// Threads  plain values.

#include "engine/display/output.h"

#include <array>
#include <cstdint>
#include <vector>

namespace stadion {

/// The factor of a channel's values that leaves this part of its light.
double channelGain(double brightness);

class OutputColours {
public:
  explicit OutputColours(const OutputShape& shape);

  /// False if values stay as they are.
  bool changes() const { return changes_; }
  /// `pixel` is 0xAABBGGRR, as pictures have it in memory.
  std::uint32_t changed(std::uint32_t pixel) const {
    return channels_[0][pixel & 255] | std::uint32_t{channels_[1][pixel >> 8 & 255]} << 8 |
           std::uint32_t{channels_[2][pixel >> 16 & 255]} << 16 | (pixel & 0xff000000);
  }

private:
  bool changes_;
  std::array<std::array<std::uint8_t, 256>, 3> channels_{};
};

/// The red value of an anaglyph: the left eye's luminance.
class AnaglyphRed {
public:
  explicit AnaglyphRed(const OutputShape& shape);

  /// `pixel` is 0xAABBGGRR.
  std::uint8_t operator()(std::uint32_t pixel) const {
    const std::uint32_t light =
        lights_[0][pixel & 255] + lights_[1][pixel >> 8 & 255] + lights_[2][pixel >> 16 & 255];
    std::uint32_t value = first_[light >> kShift];
    while (value < 255 && light >= least_[value + 1]) ++value;
    return static_cast<std::uint8_t>(value);
  }

private:
  static constexpr std::uint32_t kFull = 1u << 28, kShift = 16;  ///< all light; of a light's table index

  std::array<std::array<std::uint32_t, 256>, 3> lights_{};   ///< parts of the luminance, by channel and value
  std::array<std::uint32_t, 256> least_{};                   ///< light for that value of red
  std::array<std::uint8_t, (kFull >> kShift) + 2> first_{};  ///< value of the least light with this index
};

}  // namespace stadion
