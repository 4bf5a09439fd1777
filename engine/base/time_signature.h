#pragma once
/// Show time: integer nanoseconds, so that every replica agrees on it to the bit.

#include <array>
#include <cstdint>

namespace stadion {

using Nanoseconds = std::int64_t;  ///< show time or a duration [ns]

constexpr double toSeconds(Nanoseconds ns) {
  return static_cast<double>(ns) * 1e-9;
}
constexpr Nanoseconds fromSeconds(double s) {
  return static_cast<Nanoseconds>(s * 1e9 + (s >= 0 ? 0.5 : -0.5));
}

/// A decision about overload: a degradation from a frame on (engine/core/cost_budget.h).
struct DegradationDecision {
  std::uint32_t load = 0,
                position = 0;  ///< the node, by load number and position in its file; 0, 0 = the show
  std::uint32_t level = 0;     ///< level on the node's ladder; for the show: stress, in quarters of an octave

  bool operator==(const DegradationDecision&) const = default;
};
constexpr std::uint32_t kStressLevelsAnOctave = 4;
constexpr std::uint32_t kMostStress = 16;  ///< the highest level of stress: 16 times

/// The decisions that take effect with one frame. Further ones wait for the next frame.
struct FrameDecisions {
  static constexpr std::size_t kMost = 4;
  std::array<DegradationDecision, kMost> decisions{};
  std::uint32_t count = 0;

  const DegradationDecision* begin() const { return decisions.data(); }
  const DegradationDecision* end() const { return decisions.data() + count; }
  /// False if there is no room.
  bool add(const DegradationDecision& d) {
    if (count == kMost) return false;
    decisions[count++] = d;
    return true;
  }
};

/// The data that every replica receives for a frame, besides the input sample. App advances the show from
/// `time - step` to `time`.
struct TimeSignature {
  std::uint64_t frame = 0;     ///< index, from 0
  Nanoseconds time = 0;        ///< end of this frame's step [ns]
  Nanoseconds step = 0;        ///< [ns]; 0 in frame 0, which shows the scene as it was loaded
  FrameDecisions decisions{};  ///< degradations that begin or end with this frame
};

/// Frame n of a show at `rate` frames per second, without accumulated rounding.
constexpr TimeSignature signatureAt(std::uint64_t frame, double rate) {
  const auto at = [rate](std::uint64_t n) { return fromSeconds(static_cast<double>(n) / rate); };
  return {frame, at(frame), frame == 0 ? 0 : at(frame) - at(frame - 1), {}};
}

}  // namespace stadion
