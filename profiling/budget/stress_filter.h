#pragma once
/// Stress of the whole show, as in IRIS Performer: if drawing takes too large a part of the frame, levels of
/// detail are chosen as if everything were farther away.
///
///     load = time x rate / frac
///     stress += scale x load   if load > high,  at most max
///     stress -= scale x load   if load < low,   at least 1
///
/// The greatest load of all walls counts, so that an object has one level everywhere. The published value is
/// the nearest quarter of an octave. It changes only when the stress is well beyond the middle between two.
///
/// Units    load: parts of a frame.
/// Threads  plain values.

#include <cstdint>

namespace stadion {

struct StressOptions {
  double frac = 1;     ///< part of a frame that drawing may take
  double low = 0.7;    ///< load below which stress goes down
  double high = 0.95;  ///< load above which it goes up
  double scale = 0.1;  ///< how fast
  double max = 4;      ///< 1 = stress is off
};

class StressFilter {
public:
  explicit StressFilter(const StressOptions& options) : options_(options) {}

  /// `time`: of the slowest wall's stages in one frame, in parts of a frame. Returns the level of stress.
  std::uint32_t take(double time);
  double stress() const { return stress_; }
  std::uint32_t level() const { return level_; }
  /// The highest level that its options allow.
  std::uint32_t most() const;
  /// Returns true if it cannot rise further.
  bool exhausted() const { return stress_ >= options_.max; }

private:
  StressOptions options_;
  double stress_ = 1;
  std::uint32_t level_ = 0;
};

}  // namespace stadion
