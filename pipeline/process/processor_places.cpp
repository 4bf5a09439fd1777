#include "pipeline/process/processor_places.h"

#include <algorithm>

namespace stadion::wall_process {

ProcessorPlaces::ProcessorPlaces(const ProcessorSet& processors) {
  for (std::size_t i = 0; i < ProcessorSet::kMost; ++i)
    if (processors.contains(i)) free_.push_back(i);
  if (free_.empty()) free_.push_back(0);
}

std::size_t ProcessorPlaces::take(double cost) {
  std::unique_lock lock(mutex_);
  if (!free_.empty()) {
    const std::size_t processor = free_.back();
    free_.pop_back();
    return processor;
  }
  Waiting me{cost};
  waiting_.push_back(&me);
  changed_.wait(lock, [&] { return me.processor.has_value(); });
  return *me.processor;
}

void ProcessorPlaces::giveBack(std::size_t processor) {
  const std::lock_guard lock(mutex_);
  const auto next = std::ranges::max_element(waiting_, {}, &Waiting::cost);
  if (next == waiting_.end()) {
    free_.push_back(processor);
    return;
  }
  (*next)->processor = processor;
  waiting_.erase(next);
  changed_.notify_all();
}

}  // namespace stadion::wall_process
