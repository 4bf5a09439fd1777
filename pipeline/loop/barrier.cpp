#include "pipeline/loop/barrier.h"

namespace stadion {

bool Barrier::wait(std::unique_lock<std::mutex>& lock) {
  const std::uint64_t mine = epoch_;
  changed_.wait(lock, [&] { return epoch_ != mine || stopped_; });
  return epoch_ != mine;
}

void Barrier::stop() {
  const std::lock_guard lock(mutex_);
  stopped_ = true;
  changed_.notify_all();
}

}  // namespace stadion
