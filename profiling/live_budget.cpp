#include "profiling/live_budget.h"

#include <algorithm>

namespace stadion {
namespace {

constexpr double kNewest = 0.1;
constexpr std::chrono::seconds kStill{1};  ///< after so long without a swap there is no rate

double millisecondsBetween(std::chrono::steady_clock::time_point a, std::chrono::steady_clock::time_point b) {
  return std::chrono::duration<double, std::milli>(b - a).count();
}

}  // namespace

void LiveBudget::Mean::add(double value) {
  ms = any ? ms + kNewest * (value - ms) : value;
  any = true;
}

void LiveBudget::began(Span what, std::uint64_t, std::uint32_t wall) {
  if (!isStage(what)) return;
  const std::lock_guard lock(mutex_);
  walls_[{std::this_thread::get_id(), what}] = wall;
  means_[{what, wall}].began = Clock::now();
}

void LiveBudget::ended(Span what) {
  if (!isStage(what)) return;
  const std::lock_guard lock(mutex_);
  const auto now = Clock::now();
  Mean& mean = means_[{what, walls_[{std::this_thread::get_id(), what}]}];
  mean.add(millisecondsBetween(mean.began, now));
  if (what != Span::Swap) return;
  if (period_.began != Clock::time_point{}) period_.add(millisecondsBetween(period_.began, now));
  period_.began = now;
}

double LiveBudget::slowest(Span stage) const {
  double most = 0;
  for (const auto& [who, mean] : means_)
    if (who.first == stage) most = std::max(most, mean.ms);
  return most;
}

FrameBudget LiveBudget::now() const {
  const std::lock_guard lock(mutex_);
  const bool alive = Clock::now() - period_.began < kStill && period_.ms > 0;
  return {slowest(Span::App), slowest(Span::Cull), slowest(Span::Draw), alive ? 1000 / period_.ms : 0};
}

}  // namespace stadion
