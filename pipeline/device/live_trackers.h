#pragma once
/// Trackers of a live show: a feed that devices fill on threads of their own and App reads.
///
/// Threads  post functions and headSoon() from any thread; the rest of the InputDevice is App's. Nobody waits
/// longer than a few
///          microseconds for the others.

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

  /// `tell` learns once of each unknown name and of the first thing refused, and of trackers that fall silent
  /// and are heard of again. `clock` for tests.
  LiveTrackers(const RigFile& rig, Tell tell, std::function<Nanoseconds()> clock = steadyNow);

  void pose(std::string_view tracker, Nanoseconds clock, const Pose& X_SD);
  void button(std::string_view tracker, Nanoseconds clock, std::int64_t index, bool down);
  void axis(std::string_view tracker, Nanoseconds clock, std::int64_t index, double value);
  /// A measurement came later than a newer one, and is left out.
  void late(std::string_view tracker);
  /// The clock of the tracker's sender was set by so much [ns], which is told once.
  void clockWasSet(std::string_view tracker, Nanoseconds by);
  /// Whether the rig file has it.
  bool knows(std::string_view tracker) const { return feed_.rig().find(tracker) != nullptr; }
  /// Something came that is no measurement at all.
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
  void tellHearings();

  mutable std::mutex mutex_;
  TrackerFeed feed_;
  Tell tell_;
  std::function<Nanoseconds()> clock_;
  std::set<std::string, std::less<>> told_;
};

}  // namespace stadion
