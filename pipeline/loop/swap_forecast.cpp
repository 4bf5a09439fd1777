#include "pipeline/loop/swap_forecast.h"

#include <algorithm>

namespace stadion {

void SwapForecast::note(Clock::duration startToSwap) {
  took_[count_++ % kLooksBack] = std::chrono::duration_cast<std::chrono::nanoseconds>(startToSwap).count();
  std::array<Nanoseconds, kLooksBack> known = took_;
  const auto end = known.begin() + static_cast<std::ptrdiff_t>(std::min(count_, kLooksBack));
  const auto middle = known.begin() + (end - known.begin()) / 2;
  std::nth_element(known.begin(), middle, end);
  expected_ = *middle;
}

}  // namespace stadion
