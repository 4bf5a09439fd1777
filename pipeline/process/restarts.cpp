#include "pipeline/process/restarts.h"

#include <algorithm>

namespace stadion::wall_process {

Restarts::Death Restarts::died(Clock::time_point now) {
  if (drawn_ >= kSteady) deaths_ = 0;
  drawn_ = 0;
  ++deaths_;
  constexpr std::size_t kMostDoublings = 10;
  const auto pause = kShortest * (1 << std::min(std::max<std::size_t>(deaths_, 2) - 2, kMostDoublings));
  next_ = deaths_ == 1 ? now : now + std::min<Milliseconds>(pause, kLongest);
  return deaths_ == 1 ? Death::First : deaths_ == 2 ? Death::Second : Death::Further;
}

bool Restarts::drew() {
  ++drawn_;
  const bool back = (deaths_ == 1 && drawn_ == 1) || (deaths_ > 1 && drawn_ == kSteady);
  if (drawn_ >= kSteady) deaths_ = 0;
  return back;
}

}  // namespace stadion::wall_process
