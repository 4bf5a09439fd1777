#pragma once
/// Lets several threads go on together: each waits until all have arrived.
///
/// Threads  any. The last one to arrive runs the action while the others wait.

#include "engine/base/time_signature.h"

#include <condition_variable>
#include <cstddef>
#include <mutex>

namespace stadion {

class Barrier {
public:
  explicit Barrier(std::size_t parties) : parties_(parties) {}

  /// Waits for the others. The last one to arrive runs `action`, then all go on. Returns false if the run was
  /// stopped.
  template <class Action>
  bool arrive(const Action& action) {
    std::unique_lock lock(mutex_);
    if (stopped_) return false;
    if (++arrived_ < parties_) return wait(lock);
    action();
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
  std::size_t parties_, arrived_ = 0;
  std::uint64_t epoch_ = 0;
  bool stopped_ = false;
};

}  // namespace stadion
