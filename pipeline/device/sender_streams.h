#pragma once
/// Measurements that come in packets, by the clocks of their senders.
///
/// A packet may say when its sender measured. That orders and spaces measurements better than their arrival does.
/// Each sender has a clock of its own for each tracker, and may set it (sender_clock.h).
///
/// Threads  one at a time.

#include "pipeline/device/live_trackers.h"
#include "pipeline/device/sender_clock.h"

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace stadion {

/// What a device says about one tracker.
struct Measurement {
  enum class Kind { Pose, Button, Axis };
  Kind kind = Kind::Pose;
  /// Pose: position and quaternion (x y z qx qy qz qw) in the rig file's unit. Button: number from 1, then 1 if it
  /// is down. Axis: number from 0, then its value.
  std::array<double, 7> numbers{};
};

class SenderStreams {
public:
  /// The trackers must outlive it.
  explicit SenderStreams(LiveTrackers& trackers) : trackers_(trackers) {}

  /// Gives the measurement to the trackers. `sent`: when it was made, by the clock of the host `from` [ns]; nothing:
  /// now.
  void take(std::string_view tracker, const Measurement& m, std::string_view from,
            std::optional<Nanoseconds> sent);

private:
  /// One sender's data for one tracker: its poses, or its buttons and axes.
  struct Stream {
    std::string host, tracker;
    bool poses;
    SenderClock clock;
    std::vector<Measurement> late{};  ///< buttons and axes since the last one that was not late
  };

  void takeStamped(std::string_view tracker, const Measurement& m, std::string_view host, Nanoseconds sent);
  void post(std::string_view tracker, Nanoseconds clock, const Measurement& m);
  Stream& streamOf(std::string_view host, std::string_view tracker, bool poses);

  LiveTrackers& trackers_;
  std::vector<Stream> streams_;
};

}  // namespace stadion
