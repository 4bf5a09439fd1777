#pragma once
/// The world's clock: the present part of a frame, and the window of prediction that contains it.
///
/// Units    show time in nanoseconds; tau in seconds since the start of the window.
/// Windows  last 128 ms to 1 s and begin on a grid of show time, so that they do not depend on frames. The
///          world predicts contacts to the end of the window, but knows external motion only to the end of
///          the part.

#include "dynamics/motion/instant.h"

#include <algorithm>
#include <cstdint>

namespace stadion {

class WorldTime {
public:
  static constexpr Nanoseconds kWindow = 128'000'000;  ///< a multiple of the contact solver's grid
  static constexpr Nanoseconds kLongestWindow = 8 * kWindow;

  bool started() const { return started_; }
  void start(Nanoseconds at) {
    started_ = true;
    t0_ = t1_ = at;
  }
  void nextFrame() { ++frame_; }
  /// A part of a frame begins.
  void beginPart(Nanoseconds from, Nanoseconds to) {
    t0_ = from;
    t1_ = to;
    measurePart();
  }
  /// Show time goes on to `to` while the world stands still.
  void standUntil(Nanoseconds to) { t0_ = t1_ = to; }
  void openWindow(Nanoseconds at, Nanoseconds length) {
    origin_ = at;
    window_ = length;
    measurePart();
  }
  void shortenWindow() { window_ = kWindow; }

  std::uint64_t frame() const { return frame_; }  ///< counts frames
  Nanoseconds t0() const { return t0_; }          ///< start of the part
  Nanoseconds t1() const { return t1_; }          ///< end of the part; between frames, of the last one
  double partStart() const { return partStart_; }      ///< tau of t0
  double partEnd() const { return partEnd_; }         ///< tau of t1; may lie beyond the window

  Nanoseconds origin() const { return origin_; }  ///< start of the window
  Nanoseconds window() const { return window_; }  ///< length of the window
  double windowEnd() const { return toSeconds(window_); }
  bool inWindow(Nanoseconds when) const { return when < origin_ + window_; }

  Nanoseconds timeAt(double tau) const { return instantAt(tau).rounded(); }
  double tauOf(Nanoseconds time) const { return toSeconds(time - origin_); }
  Instant instantAt(double tau) const { return Instant{origin_, 0}.plus(tau); }
  /// The share of the present part that is over at tau, in [0, 1].
  double shareAt(double tau) const {
    return partEnd_ > partStart_ ? std::clamp((tau - partStart_) / (partEnd_ - partStart_), 0.0, 1.0) : 1;
  }

  template <class Fields>
  void state(Fields& f) {
    f("started", started_), f("t0", t0_), f("t1", t1_), f("origin", origin_), f("window", window_);
    f("from", partStart_), f("now", partEnd_), f("frame", frame_);
    // The present lies in the window: from elsewhere, its end would be hours of simulation away.
    const bool isWindow = window_ >= kWindow && window_ <= kLongestWindow;
    const bool isNow = t0_ >= 0 && t0_ <= t1_ && origin_ >= 0 && origin_ <= t1_ && t1_ - origin_ < window_;
    if (f.restores() && !(isWindow && isNow)) f.fail();
  }

private:
  void measurePart() {
    partStart_ = tauOf(t0_);
    partEnd_ = tauOf(t1_);
  }

  bool started_ = false;
  Nanoseconds t0_ = 0, t1_ = 0, origin_ = 0;
  Nanoseconds window_ = kWindow;
  double partStart_ = 0, partEnd_ = 0;
  std::uint64_t frame_ = 0;
};

}  // namespace stadion
