#include "profiling/report/frame_series.h"

#include <algorithm>

namespace stadion {

void FrameSeries::add(const FrameFacts& f) {
  FrameRow row;
  row.frame = f.frame;
  row.period = f.period;
  row.app = f.app.ms;
  walls_ = f.cull.size();
  for (const StageFacts& stage : f.cull) stages_.push_back(stage.ms);
  for (const StageFacts& stage : f.draw) stages_.push_back(stage.ms);
  row.sampled = f.sampled != 0;
  row.cause = f.cause;
  rows_.push_back(row);
  if (row.sampled || f.period <= 0) return;
  ++causes_[f.cause];
  if (f.cause == Cause::None) return;
  late_.emplace(f.period, f);
  if (late_.size() > kMostLate) late_.erase(late_.begin());
}

std::vector<FrameFacts> FrameSeries::late() const {
  std::vector<FrameFacts> late;
  for (const auto& [period, facts] : late_) late.push_back(facts);
  std::ranges::sort(late, {}, &FrameFacts::frame);
  return late;
}

}  // namespace stadion
