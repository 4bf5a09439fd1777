#pragma once
/// A visitor without end for `stadion soak`: looks around, takes a ball and throws it every few seconds, and
/// has trackers that sometimes fail. What it does depends on show time alone, so that every run is the same.
///
/// The measurements go through TrackerFeed, as those of live trackers do, by a clock that is show time.
///
/// Threads  App's.

#include "engine/input/input_device.h"
#include "engine/input/tracker_feed.h"

namespace stadion {

class SoakVisitor final : public InputDevice {
public:
  SoakVisitor() : feed_(standardRig()) {}

  using InputDevice::sampleAt;
  void sampleAt(Nanoseconds showTime, InputSample& sample) override {
    sampleFrame(showTime, showTime, sample);
  }
  void sampleFrame(Nanoseconds start, Nanoseconds end, InputSample& sample) override;
  void restart() override;

  std::uint64_t throws() const { return throws_; }
  /// Counts what was no measurement: not finite, too far, of an unknown tracker.
  std::uint64_t refused() const { return feed_.counts().refused + feed_.counts().unknown; }

private:
  void measure(Nanoseconds at);

  TrackerFeed feed_;
  bool holds_ = false;
  std::uint64_t throws_ = 0;
};

}  // namespace stadion
