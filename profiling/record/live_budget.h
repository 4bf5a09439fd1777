#pragma once
/// The current costs of frames, for display while the show plays.
///
/// Each value is the mean of about the last second: new durations count a tenth.
///
/// Threads  SpanReader's; read from any.

#include "profiling/record/frame_log.h"

#include <chrono>
#include <map>
#include <mutex>
#include <utility>

namespace stadion {

struct FrameBudget {
  double appMs = 0;
  double cullMs = 0, drawMs = 0;  ///< costs of the slowest wall
  double framesPerSecond = 0;
};

class LiveBudget final : public SpanReader {
public:
  using SpanReader::take;
  void take(std::size_t track, const SpanRecord& record) override;

  FrameBudget now() const;

private:
  struct Mean {
    double ms = 0;
    bool any = false;
    void add(double value);
  };

  double slowest(Span stage) const;

  mutable std::mutex mutex_;
  std::map<std::pair<Span, std::uint32_t>, Mean> means_;  ///< by stage and wall
  Mean period_;                                           ///< from swap to swap
  ProfileClock::time_point swapped_{};
};

}  // namespace stadion
