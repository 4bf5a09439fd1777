#pragma once
/// Threads for which other machines wait run as soon as they wake, also where others compute.
///
/// How     such a thread waits and answers, and computes next to nothing. Where the system lets it (root, or
///         RLIMIT_RTPRIO) it becomes a real-time one of the lowest priority. Elsewhere the scheduler is asked
///         for short turns of it (`sched_runtime` of sched_setattr(2)), which may interrupt long ones: Linux
///         heeds that from 6.12 on. Neither gives anybody a greater share of a processor.
/// Nesting one at a time on a thread.
/// Left    threads that somebody has given another policy than the usual one.
/// Errors  none: who is refused both runs as before.

#include <cstdint>

namespace stadion {

/// The calling thread, for as long as this lives; the same thread ends it.
class Promptness {
public:
  enum class For { This, ThoseItStarts };  ///< the latter, in that time, for as long as they live

  explicit Promptness(For whom = For::This);
  ~Promptness();
  Promptness(const Promptness&) = delete;
  Promptness& operator=(const Promptness&) = delete;

private:
  bool handedDown_, changed_ = false;
  std::int32_t nice_ = 0;  ///< before
};

}  // namespace stadion
