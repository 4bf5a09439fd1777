#pragma once
/// Lets threads run as soon as they wake, even on a busy machine. Other hosts wait for these threads.
///
/// How     Such a thread waits and answers, and computes next to nothing. If the system permits it (root, or
///         RLIMIT_RTPRIO), it becomes a real-time thread of the lowest priority. Otherwise the scheduler is
///         asked for short turns (`sched_runtime` of sched_setattr(2)), which may interrupt long ones; Linux
///         honours this from 6.12 on. Neither gives a thread a greater share of a processor. Do not nest
///         two on one thread.
/// Left    threads with another policy than the usual one are unchanged.
/// Errors  none: if the system refuses both, the thread runs as before.

#include <cstdint>

namespace stadion {

/// Applies to the calling thread during its lifetime. The same thread must destroy it.
class ScopedRealtimePriority {
public:
  enum class For {
    This,
    ThoseItStarts,  ///< threads that the caller starts meanwhile, for their whole lives
  };

  explicit ScopedRealtimePriority(For threads = For::This);
  ~ScopedRealtimePriority();
  ScopedRealtimePriority(const ScopedRealtimePriority&) = delete;
  ScopedRealtimePriority& operator=(const ScopedRealtimePriority&) = delete;

private:
  bool handedDown_, changed_ = false;
  std::int32_t nice_ = 0;  ///< before
};

}  // namespace stadion
