#pragma once
/// Lets all walls show the same frame together: each waits until all have drawn.
///
/// Threads  any. The last one to arrive runs the action while the others wait.

#include "engine/base/time_signature.h"

#include <condition_variable>
#include <cstddef>
#include <mutex>

namespace stadion {

class SwapBarrier {
public:
  explicit SwapBarrier(std::size_t walls) : walls_(walls) {}

  /// Waits for the other walls. The last one to arrive runs `show`, then all go on. Returns false if the run
  /// was stopped.
  template <class Show>
  bool arrive(const Show& show) {
    std::unique_lock lock(mutex_);
    if (stopped_) return false;
    if (++arrived_ < walls_) return wait(lock);
    show();
    arrived_ = 0;
    ++epoch_;
    changed_.notify_all();
    return true;
  }
  void stop();

private:
  bool wait(std::unique_lock<std::mutex>& lock);

  std::mutex mutex_;
  std::condition_variable changed_;
  std::size_t walls_, arrived_ = 0;
  std::uint64_t epoch_ = 0;
  bool stopped_ = false;
};

}  // namespace stadion
