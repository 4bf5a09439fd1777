#include "profiling/load/stress_filter.h"

#include "engine/time_signature.h"

#include <algorithm>
#include <cmath>

namespace stadion {

std::uint32_t StressFilter::take(double time) {
  constexpr double kBeyond = 0.65;  // of a level's width; half is the middle between two
  const double load = time / options_.frac;
  if (load > options_.high) stress_ += options_.scale * load;
  if (load < options_.low) stress_ -= options_.scale * load;
  stress_ = std::clamp(stress_, 1.0, std::max(1.0, options_.max));
  const double exact = kStressLevelsAnOctave * std::log2(stress_);
  const bool atEnd = stress_ == 1 || exhausted();
  if (std::abs(exact - level_) > kBeyond || atEnd)
    level_ = std::min(static_cast<std::uint32_t>(std::lround(exact)), kMostStress);
  return level_;
}

}  // namespace stadion
