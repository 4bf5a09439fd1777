#pragma once
/// Late latch: just before a frame is drawn, the head's newest pose replaces the one that App sampled one or
/// two frames earlier.
///
/// It is taken once a frame, by the wall that comes first, so that all views show the room from
/// the same head and no edge between walls is seen. What was culled stays: Cull has looked for what may be
/// seen from anywhere within the reach (WallViews::reach), and a head that has gone farther is drawn from its
/// edge, and counted. Lights, shadows and the order of what is transparent are those of App's pose.
///
/// Pictures then depend on the time at which they were drawn.
///
/// Frames   R is the rig; it stays where App has put it.
/// Threads  latch() on any wall's Draw thread, all walls at the same frame; the counts after the run.

#include "engine/input/input_device.h"
#include "pipeline/view/wall_views.h"

#include <chrono>
#include <cstdint>
#include <mutex>

namespace stadion {

/// Counts of latched frames.
struct LatchCounts {
  std::uint64_t latched = 0;  ///< had a newer pose
  std::uint64_t beyond = 0;   ///< frames in which the head was farther away than the reach
  double farthest = 0;        ///< [m]
  double widest = 0;          ///< [rad]
};

class HeadLatch {
public:
  using TimePoint = std::chrono::steady_clock::time_point;

  /// Borrows the device, which must implement headSoon().
  HeadLatch(InputDevice& input, const HeadReach& reach) : input_(input), reach_(reach) {}

  /// Sets the eyes of the list's views to the newest head pose, predicted for `seen`: the time at which the
  /// pictures are expected to be shown. If `seen` is past, predicts for now. Without newer head data, the
  /// list stays unchanged.
  void latch(const WallViews& wall, TimePoint seen, DrawList& list);

  const LatchCounts& counts() const { return counts_; }

private:
  struct Taken {
    TimePoint frame{};  ///< start of the frame, which identifies it
    std::optional<Pose> X_RH;
    TimePoint measured{};
  };
  Taken take(const DrawList& list, TimePoint seen);

  InputDevice& input_;
  const HeadReach reach_;
  std::mutex mutex_;
  Taken taken_;
  LatchCounts counts_;
};

}  // namespace stadion
