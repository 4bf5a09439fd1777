#pragma once
/// The speed and pausing of show time, as the user of a live run controls them.
///
/// While the show is paused, its App stage rests. The last published frame is still culled and drawn, so
/// cameras other than the visitor's can move. In slow motion, frames come at the same rate, and each advances
/// the show less. The resulting times are in the frames' signatures, and so in the input log.
///
/// Threads  every function from any thread; FrameLoop asks once a frame.

#include "engine/base/time_signature.h"

#include <algorithm>
#include <atomic>

namespace stadion {

class Playback {
public:
  static constexpr double kSlowest = 1.0 / 64;

  void setPaused(bool paused) { paused_ = paused; }
  bool paused() const { return paused_; }
  /// Stops show time while `holds` is true, also for steps.
  void hold(bool holds) { held_ = holds; }
  /// Pauses from this show time on. A show that continues from an earlier time first plays up to it.
  void standFrom(Nanoseconds time) { standsFrom_ = time; }
  Nanoseconds standsFrom() const { return standsFrom_; }
  /// Plays one frame at full speed, and pauses after it.
  void step() {
    paused_ = true;
    ++steps_;
  }
  /// Returns the single frames still to be played.
  int stepsWaiting() const { return steps_; }
  /// 1 = real time.
  void setSpeed(double speed) { speed_ = std::clamp(speed, kSlowest, 1.0); }
  double speed() const { return speed_; }

  /// Returns how far show time advances after the frame at `time`, in parts of a frame; 0 = it stands still.
  double takeFrame(Nanoseconds time) {
    if (held_) return 0;
    if (!paused_) return speed_;
    if (time < standsFrom_) return 1;
    int waiting = steps_;
    while (waiting > 0 && !steps_.compare_exchange_weak(waiting, waiting - 1)) {
    }
    return waiting > 0 ? 1 : 0;
  }

private:
  std::atomic<bool> paused_ = false, held_ = false;
  std::atomic<int> steps_ = 0;
  std::atomic<double> speed_ = 1;
  std::atomic<Nanoseconds> standsFrom_ = 0;
};

}  // namespace stadion
