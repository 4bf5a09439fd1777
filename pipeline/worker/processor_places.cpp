#include "pipeline/worker/processor_places.h"

#include <algorithm>
#include <sched.h>

namespace stadion::worker {

std::vector<int> ownProcessors() {
  cpu_set_t set;
  CPU_ZERO(&set);
  std::vector<int> processors;
  if (::sched_getaffinity(0, sizeof set, &set) == 0)
    for (int i = 0; i < CPU_SETSIZE; ++i)
      if (CPU_ISSET(i, &set)) processors.push_back(i);
  if (processors.empty()) processors.push_back(0);
  return processors;
}

void bindProcess(int pid, std::span<const int> processors) {
  cpu_set_t set;
  CPU_ZERO(&set);
  for (const int p : processors) CPU_SET(p, &set);
  if (pid > 0) ::sched_setaffinity(pid, sizeof set, &set);
}

int ProcessorPlaces::take(double cost) {
  std::unique_lock lock(mutex_);
  if (!free_.empty()) {
    const int processor = free_.back();
    free_.pop_back();
    return processor;
  }
  Waiting me{cost};
  waiting_.push_back(&me);
  changed_.wait(lock, [&] { return me.processor.has_value(); });
  return *me.processor;
}

void ProcessorPlaces::giveBack(int processor) {
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

}  // namespace stadion::worker
