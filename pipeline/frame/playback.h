#pragma once
/// Whether show time goes on, and how fast: what somebody at the controls of a live run decides.
///
/// While the show is paused its App stage rests; what it published last is still culled and drawn, so that
/// cameras which are not the visitor's stay alive. In slow motion frames come as often as ever, and each
/// takes the show less far. The times that come of it are in the frames' signatures, and so in the input log.
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
  /// Lets nothing through, whoever wants to go on or to step, as long as it holds.
  void hold(bool holds) { held_ = holds; }
  /// A pause holds from this show time on: a show that goes on from further back comes to it first.
  void standFrom(Nanoseconds time) { standsFrom_ = time; }
  Nanoseconds standsFrom() const { return standsFrom_; }
  /// Plays one frame at full speed, and pauses after it.
  void step() {
    paused_ = true;
    ++steps_;
  }
  /// Single frames that are still to come.
  int stepsWaiting() const { return steps_; }
  /// 1 = as the clock goes.
  void setSpeed(double speed) { speed_ = std::clamp(speed, kSlowest, 1.0); }
  double speed() const { return speed_; }

  /// How far the frame after the one of that show time goes, in parts of a frame: 0 = the show stands still.
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
