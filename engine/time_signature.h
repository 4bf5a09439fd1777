#pragma once
/// Show time: integer nanoseconds, so that every replica agrees on it to the bit.

#include <cstdint>

namespace stadion {

using Nanoseconds = std::int64_t;  ///< show time or a duration [ns]

constexpr double toSeconds(Nanoseconds ns) {
  return static_cast<double>(ns) * 1e-9;
}
constexpr Nanoseconds fromSeconds(double s) {
  return static_cast<Nanoseconds>(s * 1e9 + (s >= 0 ? 0.5 : -0.5));
}

/// What every replica receives for a frame, besides the input sample. App advances the show from
/// `time - step` to `time`.
struct TimeSignature {
  std::uint64_t frame = 0;  ///< index, from 0
  Nanoseconds time = 0;     ///< end of this frame's step [ns]
  Nanoseconds step = 0;     ///< [ns]; 0 in frame 0, which shows the scene as it was loaded
};

/// Frame n of a show at `rate` frames per second, without accumulated rounding.
constexpr TimeSignature signatureAt(std::uint64_t frame, double rate) {
  const auto at = [rate](std::uint64_t n) { return fromSeconds(static_cast<double>(n) / rate); };
  return {frame, at(frame), frame == 0 ? 0 : at(frame) - at(frame - 1)};
}

}  // namespace stadion
