#pragma once
/// Durations of the stages, and the age of the head's pose when its picture was shown.
///
/// Threads  each series is written by one thread at a time and read when the run is over.

#include "engine/core/frame_probe.h"

#include <chrono>
#include <cstdint>
#include <vector>

namespace stadion {

/// The last durations of one kind [ms], in no particular order. Bounded, so that a show may run for days.
class DurationSeries {
public:
  /// Reserves all room at once, so that a frame allocates nothing. Unused room takes no memory.
  void makeRoom() { values_.reserve(kCapacity); }
  void add(double ms) {
    if (values_.size() < kCapacity)
      values_.push_back(ms);
    else
      values_[count_ % kCapacity] = ms;
    ++count_;
  }
  const std::vector<double>& values() const { return values_; }
  std::uint64_t count() const { return count_; }

private:
  static constexpr std::size_t kCapacity = 1 << 16;
  std::vector<double> values_;
  std::uint64_t count_ = 0;
};

struct FrameTimes {
  explicit FrameTimes(std::size_t walls) : cull(walls), draw(walls), latency(walls) {
    for (DurationSeries* series : {&app, &swap, &period}) series->makeRoom();
    for (auto* ofWalls : {&cull, &draw, &latency})
      for (DurationSeries& series : *ofWalls) series.makeRoom();
  }

  DurationSeries app;
  std::vector<DurationSeries> cull, draw;  ///< by wall
  DurationSeries swap;                     ///< handing a frame's outputs on
  DurationSeries period;                   ///< from swap to swap
  /// Time before the first frame is drawn [ms]: contexts, shaders, uploads. The other series exclude it.
  double warmUp = 0;
  /// By wall: from the measurement of the head's pose, with which its picture was drawn, to the swap.
  std::vector<DurationSeries> latency;
};

}  // namespace stadion
