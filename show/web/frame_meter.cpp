#include "show/web/frame_meter.h"

#include <algorithm>
#include <cmath>

namespace stadion {
namespace {

constexpr double kNewestShare = 0.1;
constexpr std::chrono::seconds kNothingShown{1};

double secondsBetween(ProfileClock::time_point a, ProfileClock::time_point b) {
  return std::chrono::duration<double>(b - a).count();
}

}  // namespace

void DurationWindow::add(double seconds) {
  const auto value = static_cast<float>(seconds);
  if (last_.size() < kMost)
    last_.push_back(value);
  else
    last_[count_ % kMost] = value;
  ++count_;
  sum_ += seconds;
}

DurationSummary DurationWindow::summary() const {
  DurationSummary s{.count = count_, .sum = sum_};
  if (last_.empty()) return s;
  std::vector<float> sorted = last_;
  std::ranges::sort(sorted);
  const auto at = [&](double share) {
    const double rank = std::ceil(share * static_cast<double>(sorted.size())) - 1;
    return static_cast<double>(sorted[static_cast<std::size_t>(std::max(0.0, rank))]);
  };
  s.p50 = at(0.5);
  s.p90 = at(0.9);
  s.p99 = at(0.99);
  s.most = static_cast<double>(sorted.back());
  return s;
}

void FrameMeter::take(std::size_t, const SpanRecord& r) {
  if (!isStage(r.what)) return;
  const std::lock_guard lock(mutex_);
  stages_[{r.what, r.wall}].add(1e-3 * r.took);
  if (r.what == Span::Draw) drawn_[r.wall] = r.ended;
  if (r.what != Span::Swap) return;
  if (swapped_ != ProfileClock::time_point{}) {
    const double period = secondsBetween(swapped_, r.ended);
    period_.add(period);
    meanPeriod_ = meanPeriod_ > 0 ? meanPeriod_ + kNewestShare * (period - meanPeriod_) : period;
  }
  swapped_ = r.ended;
}

void FrameMeter::lateFrame(const FrameFacts& facts) {
  const std::lock_guard lock(mutex_);
  ++late_[facts.cause];
}

MeteredFrames FrameMeter::now() const {
  // Sorting takes longer than copying, and the frame log's thread is not to wait for it.
  DurationWindow period;
  std::map<std::pair<Span, std::uint32_t>, DurationWindow> stages;
  MeteredFrames metered;
  {
    const std::lock_guard lock(mutex_);
    const auto now = ProfileClock::now();
    period = period_;
    stages = stages_;
    metered.late = late_;
    for (const auto& [wall, ended] : drawn_) metered.drawnAgo[wall] = secondsBetween(ended, now);
    if (now - swapped_ < kNothingShown && meanPeriod_ > 0) metered.framesPerSecond = 1 / meanPeriod_;
  }
  metered.period = period.summary();
  for (const auto& [key, window] : stages) metered.stages[key] = window.summary();
  return metered;
}

}  // namespace stadion
