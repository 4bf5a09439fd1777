#include "profiling/record/live_budget.h"

#include <algorithm>

namespace stadion {
namespace {

constexpr double kNewest = 0.1;
constexpr std::chrono::seconds kStill{1};  ///< after this time without a swap there is no rate

double millisecondsBetween(ProfileClock::time_point a, ProfileClock::time_point b) {
  return std::chrono::duration<double, std::milli>(b - a).count();
}

}  // namespace

void LiveBudget::Mean::add(double value) {
  ms = any ? ms + kNewest * (value - ms) : value;
  any = true;
}

void LiveBudget::take(std::size_t, const SpanRecord& r) {
  if (!isStage(r.what)) return;
  const std::lock_guard lock(mutex_);
  means_[{r.what, r.wall}].add(r.took);
  if (r.what != Span::Swap) return;
  if (swapped_ != ProfileClock::time_point{}) period_.add(millisecondsBetween(swapped_, r.ended));
  swapped_ = r.ended;
}

double LiveBudget::slowest(Span stage) const {
  double most = 0;
  for (const auto& [key, mean] : means_)
    if (key.first == stage) most = std::max(most, mean.ms);
  return most;
}

FrameBudget LiveBudget::now() const {
  const std::lock_guard lock(mutex_);
  const bool alive = ProfileClock::now() - swapped_ < kStill && period_.ms > 0;
  return {slowest(Span::App), slowest(Span::Cull), slowest(Span::Draw), alive ? 1000 / period_.ms : 0};
}

}  // namespace stadion
