#pragma once
/// Durations of frames and stages while a show plays, in a form that readers may ask for at any time.
///
/// Threads  take() on the thread of the frame log, never on one of a frame; lateFrame() likewise; the rest from any.
/// Units    seconds, as Prometheus wants them.

#include "profiling/record/frame_facts.h"
#include "profiling/record/frame_log.h"

#include <array>
#include <chrono>
#include <cstdint>
#include <map>
#include <mutex>
#include <utility>
#include <vector>

namespace stadion {

/// The last durations of one kind, and the sum of all.
struct DurationSummary {
  std::uint64_t count = 0;
  double sum = 0;
  double p50 = 0, p90 = 0, p99 = 0, most = 0;  ///< of the last DurationWindow::kMost
};

class DurationWindow {
public:
  static constexpr std::size_t kMost = 600;  ///< ten seconds at 60 frames a second

  void add(double seconds);
  DurationSummary summary() const;

private:
  std::vector<float> last_;
  std::uint64_t count_ = 0;
  double sum_ = 0;
};

struct MeteredFrames {
  DurationSummary period;  ///< from swap to swap
  std::map<std::pair<Span, std::uint32_t>, DurationSummary>
      stages;                                ///< by stage and wall; kNoWall: App, Swap
  std::map<std::uint32_t, double> drawnAgo;  ///< by wall: since its last Draw
  std::map<Cause, std::uint64_t> late;
  double framesPerSecond = 0;  ///< of the last second; 0: nothing was shown
};

class FrameMeter final : public SpanReader {
public:
  using SpanReader::take;
  void take(std::size_t track, const SpanRecord& record) override;
  bool takesFirstFrames() const override { return true; }
  void lateFrame(const FrameFacts& facts);

  MeteredFrames now() const;

private:
  mutable std::mutex mutex_;
  DurationWindow period_;
  std::map<std::pair<Span, std::uint32_t>, DurationWindow> stages_;
  std::map<std::uint32_t, ProfileClock::time_point> drawn_;
  std::map<Cause, std::uint64_t> late_;
  ProfileClock::time_point swapped_{};
  double meanPeriod_ = 0;  ///< a mean in which each frame counts a tenth [s]
};

}  // namespace stadion
