#include "pipeline/worker/patience.h"

#include <algorithm>

namespace stadion::worker {

void Patience::took(Milliseconds time) {
  if (last_.size() == kLast) last_.erase(last_.begin());
  last_.push_back(time);
}

std::optional<Patience::Milliseconds> Patience::limit() const {
  if (last_.size() < kKnown) return {};
  std::vector<Milliseconds> sorted = last_;
  std::ranges::sort(sorted);
  return 1.5 * std::max(frame_, sorted[(sorted.size() - 1) / 2]);
}

}  // namespace stadion::worker
