#pragma once
/// What frames cost at the moment, for somebody who looks on while the show plays.
///
/// Each value is the mean of the last second or so: new durations count a tenth.
///
/// Threads  told on the threads that do the work, read from any.

#include "engine/frame_probe.h"

#include <chrono>
#include <map>
#include <mutex>
#include <thread>
#include <utility>

namespace stadion {

struct FrameBudget {
  double appMs = 0;
  double cullMs = 0, drawMs = 0;  ///< of the slowest wall
  double framesPerSecond = 0;
};

class LiveBudget final : public FrameProbe {
public:
  void began(Span what, std::uint64_t frame, std::uint32_t wall) override;
  void began(Span, NodeRef) override {}
  void ended(Span what) override;

  FrameBudget now() const;

private:
  using Clock = std::chrono::steady_clock;
  struct Mean {
    Clock::time_point began{};
    double ms = 0;
    bool any = false;
    void add(double value);
  };

  double slowest(Span stage) const;

  mutable std::mutex mutex_;
  std::map<std::pair<Span, std::uint32_t>, Mean> means_;             ///< by stage and wall
  std::map<std::pair<std::thread::id, Span>, std::uint32_t> walls_;  ///< whose stage a thread is in
  Mean period_;                                                      ///< from swap to swap
};

}  // namespace stadion
