#include "pipeline/swap_barrier.h"

namespace stadion {

bool SwapBarrier::arrive(const std::function<void()>& show) {
  std::unique_lock lock(mutex_);
  if (stopped_) return false;
  const std::uint64_t mine = round_;
  if (++arrived_ == walls_) {
    show();
    arrived_ = 0;
    ++round_;
    changed_.notify_all();
    return true;
  }
  changed_.wait(lock, [&] { return round_ != mine || stopped_; });
  return round_ != mine;
}

void SwapBarrier::stop() {
  const std::lock_guard lock(mutex_);
  stopped_ = true;
  changed_.notify_all();
}

}  // namespace stadion
