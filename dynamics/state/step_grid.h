#pragma once
/// The grids of show time on which steps of lasting contact end.

#include "dynamics/motion/instant.h"

#include <cstdint>

namespace stadion {

constexpr double kShortestStep = 1e-6;  ///< a step that would be shorter lasts one more grid interval [s]

class StepGrid {
public:
  /// Divides all steps by `parts`.
  void refine(std::uint32_t parts) {
    island_ /= parts;
    pile_ /= parts;
    islandStep_ /= parts;
    faceStep_ /= parts;
  }

  double islandStep() const { return islandStep_; }  ///< length of an island's whole step [s]
  /// Step of a ball on a face under pulls that vary in place or time [s].
  double faceStep() const { return faceStep_; }
  /// Length of an island's step that begins at `at` [s].
  double untilIslandStep(const Instant& at) const {
    Nanoseconds next = (at.rounded() / island_ + 1) * island_;
    if (Instant{next, 0}.since(at) < kShortestStep) next += island_;
    return Instant{next, 0}.since(at);
  }
  /// Returns the time until the end of the pile's step. A step shorter than an eighth of the grid lasts one
  /// more interval.
  double untilPileStep(const Instant& at) const {
    Nanoseconds next = (at.rounded() / pile_ + 1) * pile_;
    if (next - at.rounded() < pile_ / 8) next += pile_;
    return Instant{next, 0}.since(at);
  }

private:
  Nanoseconds island_ = 2'000'000;  ///< [ns]
  double islandStep_ = 2e-3;        ///< `island_` in seconds [s]
  Nanoseconds pile_ = 8'333'333;    ///< 1/120 s: frames of 60 Hz have two steps each [ns]
  double faceStep_ = 1.0 / 480;     ///< [s]
};

}  // namespace stadion
