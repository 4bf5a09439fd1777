#include "profiling/budget/stress_filter.h"

#include "engine/base/time_signature.h"

#include <algorithm>
#include <cmath>

namespace stadion {
namespace {

double exactLevel(double stress) {
  return kStressLevelsAnOctave * std::log2(stress);
}

std::uint32_t nearestLevel(double stress) {
  return std::min(static_cast<std::uint32_t>(std::lround(exactLevel(stress))), kMostStress);
}

}  // namespace

std::uint32_t StressFilter::take(double time) {
  constexpr double kBeyond = 0.65;  // of a level's width; half is the middle between two
  const double load = time / options_.frac;
  if (load > options_.high) stress_ += options_.scale * load;
  if (load < options_.low) stress_ -= options_.scale * load;
  stress_ = std::clamp(stress_, 1.0, std::max(1.0, options_.max));
  const bool atEnd = stress_ == 1 || exhausted();
  if (std::abs(exactLevel(stress_) - level_) > kBeyond || atEnd) level_ = nearestLevel(stress_);
  return level_;
}

std::uint32_t StressFilter::most() const {
  return nearestLevel(std::max(1.0, options_.max));
}

}  // namespace stadion
