#pragma once
/// Trackers of a live show: devices fill a feed on threads of their own, and App reads it.
///
/// Threads  post functions and headSoon() from any thread; the rest of the InputDevice is App's. No thread
///          waits longer than a few microseconds for the others.

#include "engine/input/input_device.h"
#include "engine/input/tracker_feed.h"

#include <functional>
#include <mutex>
#include <set>
#include <string>

namespace stadion {

/// The machine's steady clock [ns].
Nanoseconds steadyNow();

class LiveTrackers final : public InputDevice {
public:
  using Tell = std::function<void(const std::string&)>;

  /// `tell` gets a message once for each unknown name and for the first refused measurement. It also gets a
  /// message when a tracker falls silent and when it returns. `clock` is for tests.
  LiveTrackers(const RigFile& rig, Tell tell, std::function<Nanoseconds()> clock = steadyNow);

  void pose(std::string_view tracker, Nanoseconds clock, const Pose& X_SD);
  void button(std::string_view tracker, Nanoseconds clock, std::int64_t index, bool down);
  void axis(std::string_view tracker, Nanoseconds clock, std::int64_t index, double value);
  /// Reports a measurement that came later than a newer one, and is left out.
  void late(std::string_view tracker);
  /// Reports that the clock of the tracker's sender was set by this much [ns]; logged once.
  void clockWasSet(std::string_view tracker, Nanoseconds by);
  /// Returns true if the rig file has this tracker.
  bool knows(std::string_view tracker) const { return feed_.rig().find(tracker) != nullptr; }
  /// The name of the tracker that a device is: the one that the rig file has as `sent-as device`, else the one that
  /// is called like the device, else `standard` if that one states no other device. Without any, the device's own.
  std::string_view nameOf(std::string_view device, std::string_view standard) const;
  /// Unit of the lengths in pose() [m].
  double unit() const { return feed_.rig().unit; }
  /// Reports a message that is no measurement.
  void misunderstood(const std::string& what);

  using InputDevice::sampleAt;
  void sampleAt(Nanoseconds showTime, InputSample& sample) override {
    sampleFrame(showTime, showTime, sample);
  }
  void sampleFrame(Nanoseconds start, Nanoseconds end, InputSample& sample) override;
  bool sampleNow(InputSample& sample) override;
  std::optional<HeadNow> headSoon(Nanoseconds ahead) override;
  void aimHead(Nanoseconds ahead) override;
  void freezeHead(bool frozen) override;
  void restart() override;

  FeedCounts counts() const;
  std::vector<TrackerFeed::Status> status() const;
  std::vector<std::string> names() const;
  Nanoseconds now() const { return clock_(); }

private:
  static constexpr std::size_t kMostToldOf = 20;

  template <class Take>
  void take(std::string_view tracker, const Take& measurement);
  void tellOnce(const std::string& what);
  void reportReception();

  mutable std::mutex mutex_;
  TrackerFeed feed_;
  Tell tell_;
  std::function<Nanoseconds()> clock_;
  std::set<std::string, std::less<>> told_;
};

}  // namespace stadion
