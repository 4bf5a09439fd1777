#pragma once
/// From measurements, as a tracking system sends them, to input samples, as the show wants them: placed in
/// the rig, smoothed, carried on to the frame's end, and led to a safe pose when they stop coming.
///
/// A tracker that has been silent for `hold` lets go of its buttons and axes. One with a safe pose then eases
/// there; after that it is lost, as is one without. When it is heard of again it eases back.
///
/// A device that has never sent a pose, such as a gamepad, is there while its buttons and axes are. If it
/// repeats its state, it is lost once that stops for three of its periods, at least `hold`. If it sends only
/// changes, it lets go of what it holds after 10 s without one.
///
/// Only trackers of the rig file are known, from the first frame on. Measurements are refused if they are not
/// finite, are absurdly far, are no rotation, or have an unknown name.
///
/// The samples are those of an input log with one record a frame, and one for each change of a button or axis
/// inside it: so a log that InputRecorder wrote gives the very same samples again.
///
/// Times    `clock` is that of the machine [ns]; show time may stand still or go slower than it. What came
///          between two frames is spread over the frame's show time in proportion.
/// Threads  one at a time (pipeline/device/live_trackers.h lets several use it).

#include "engine/input/input_device.h"
#include "engine/input/input_log.h"
#include "engine/input/one_euro_filter.h"
#include "engine/input/rig_file.h"

#include <span>
#include <string_view>

namespace stadion {

/// Counts of measurements.
struct FeedCounts {
  std::uint64_t taken = 0;
  std::uint64_t unknown = 0;  ///< measurements of trackers that the rig file does not have
  std::uint64_t refused = 0;  ///< not finite, too far, no rotation, no such button or axis
  std::uint64_t late = 0;     ///< older than one that came before
};

class TrackerFeed {
public:
  explicit TrackerFeed(const RigFile& rig);
  TrackerFeed(const TrackerFeed&) = delete;
  TrackerFeed& operator=(const TrackerFeed&) = delete;

  // Adds measurements, in any order. Returns false if one was refused, which is counted. Use SenderClock
  // (pipeline/device/sender_clock.h) for times that may be wrong.
  bool pose(std::string_view tracker, Nanoseconds clock, const Pose& X_SD);
  bool button(std::string_view tracker, Nanoseconds clock, std::int64_t index, bool down);
  bool axis(std::string_view tracker, Nanoseconds clock, std::int64_t index, double value);

  /// Counts a measurement that came later than a newer one, and is left out.
  void late() { ++counts_.late; }

  /// From now on the tracker is predicted by this much more [ns] (head_forecast.h).
  void setPrediction(std::string_view tracker, Nanoseconds ahead);
  /// Returns its predicted pose at `ahead` after `clock`, independent of setPrediction(); nothing while it is lost.
  std::optional<HeadNow> predictedHead(std::string_view tracker, Nanoseconds clock, Nanoseconds ahead) const;

  /// Freezes the tracker, or releases it, and it eases back.
  void freeze(std::string_view tracker, Nanoseconds clock, bool frozen);

  /// Starts or restarts the show's time at 0.
  void restart();
  /// A frame from `start` to `end`, which is `clock`.
  void sampleFrame(Nanoseconds clock, Nanoseconds start, Nanoseconds end, InputSample& sample);
  /// Where everything is now, apart from the show's frames.
  void sampleNow(Nanoseconds clock, InputSample& sample) const;

  /// A tracker that fell silent, or is received again.
  struct Reception {
    std::string_view tracker;
    bool heard = false;
    double silent = 0;  ///< for so long [s]
  };
  /// Returns the new ones at `clock`. For a tracker that comes and goes, once in ten seconds.
  std::vector<Reception> receptionChanges(Nanoseconds clock);

  const FeedCounts& counts() const { return counts_; }
  const RigFile& rig() const { return rig_; }

  /// A tracker's state, for people setting one up.
  struct Status {
    std::string name;
    bool heard = false;  ///< within `hold`
    bool posed = false;  ///< the tracker has sent a pose
    double age = 0;      ///< age of the last measurement [s]
    double rate = 0;     ///< measurements a second
    Pose X_SD;           ///< pose as the tracker sent it
    Pose X_RT;           ///< in the rig, smoothed
    std::uint32_t buttons = 0;
    std::array<float, kTrackerAxes> axes{};
  };
  std::vector<Status> status(Nanoseconds clock) const;

private:
  struct Change {
    Nanoseconds clock;
    std::uint32_t buttons;
    std::array<float, kTrackerAxes> axes;
  };
  struct Channel {
    Channel(const RigTracker* which, const OneEuroFilter& smooth) : tracker(which), filter(smooth) {}
    const RigTracker* tracker;
    OneEuroFilter filter;
    bool ever = false;
    Nanoseconds last = 0;   ///< measurement [ns]
    Nanoseconds ahead = 0;  ///< time for which the pose is predicted [ns]
    Pose X_SD, X_RT;        ///< pose as sent, and smoothed in the rig
    double period = 0;      ///< between measurements, smoothed [s]
    std::optional<Pose> frozen{};
    Pose from;  ///< pose when the tracker was heard again
    Nanoseconds found = 0;
    std::uint32_t buttons = 0;
    std::array<float, kTrackerAxes> axes{};
    std::vector<Change> changes;  ///< since the last frame
    // Of a device without a pose.
    bool controlled = false;      ///< buttons and axes count, although the device has no pose
    Nanoseconds lastControl = 0;  ///< last message about a button or an axis [ns]
    Nanoseconds lastChange = 0;   ///< the last one that changed something [ns]
    double beat = 0;              ///< between messages that change nothing [s]; 0: it sends changes only
    /// Time of silence, as reported; nothing: the tracker was last reported as heard.
    std::optional<Nanoseconds> silentSince{};
    std::optional<Nanoseconds> toldSilent{};  ///< when that was the last time
  };

  Channel* channel(std::string_view name);
  bool refuse() {
    ++counts_.refused;
    return false;
  }
  bool heard(const Channel& c, Nanoseconds clock) const;
  /// Returns true if it is there without a pose.
  bool controlled(const Channel& c, Nanoseconds clock) const;
  bool there(const Channel& c, Nanoseconds clock) const { return heard(c, clock) || controlled(c, clock); }
  /// Returns the time of its measurement, for the samples at `clock`; 0 if it is long ago.
  Nanoseconds measuredBy(const Channel& c, Nanoseconds clock) const { return heard(c, clock) ? c.last : 0; }
  std::optional<Pose> poseAt(const Channel& c, Nanoseconds clock, Nanoseconds ahead) const;
  std::optional<Pose> poseAt(const Channel& c, Nanoseconds clock) const { return poseAt(c, clock, c.ahead); }
  Pose extrapolated(const Channel& c, Nanoseconds clock, Nanoseconds ahead) const;
  void change(Channel& c, Nanoseconds clock, bool changes);
  void addChanges(std::span<const Change> changes, const InputStamp& now, InputTrack& track,
                  Nanoseconds clock, Nanoseconds start) const;
  void addStamps(Channel& c, InputTrack& track, Nanoseconds clock, Nanoseconds start, Nanoseconds end);

  RigFile rig_;
  std::vector<Channel> channels_;
  InputLog log_;  ///< input of the last frames, as a log would contain it
  Nanoseconds lastClock_ = 0;
  FeedCounts counts_;
};

}  // namespace stadion
