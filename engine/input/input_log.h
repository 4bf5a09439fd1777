#pragma once
/// Recorded or written input: time-stamped records of any number of named trackers, as text.
///
///     stadion-input 1
///     # a visitor looks left and kicks
///     pose head 0      0 0 1.7  1 0 0 0
///     pose head 0.5    0 0 1.7  0.9659258262890683 0 0 0.25881904510252074
///     key  foot 1      0 0 0.1
///     key  foot 1.25   0 0.8 0.3  turn 25 0 0  smooth  buttons 1
///     lost wand 2.5
///
/// The first line names the format and its version. Then one record a line, its kind first; `#` begins a
/// comment.
///     pose NAME SECONDS  X Y Z  W I J K  [smooth] [buttons N] [axes A ...]
///         position [m] and unit quaternion of the tracker in rig space
///     key NAME SECONDS  X Y Z  [turn ROLL PITCH YAW] [smooth] [buttons N] [axes A ...]
///         the same for people: angles in degrees, about the rig's X, then Y, then Z axis
///     controls NAME SECONDS  [smooth] [buttons N] [axes A ...]
///         buttons and axes of a device that has no pose, such as a gamepad
///     lost NAME SECONDS
///         the tracker is not valid until its next record
/// SECONDS has at most nine decimals and increases strictly within each tracker. `smooth` eases the way from
/// the previous record (at rest at both ends); without it the speed is constant. `buttons` is a bit mask
/// (decimal or 0x...), `axes` up to eight numbers from -1 to 1; both are 0 if omitted. Other kinds of record
/// are reserved for later versions and are errors in this one.
///
/// A log of version 2 may also hold decisions of the recorded live run, which a replay applies:
///     rate HZ
///         frames a second of the recorded run
///     frame N SECONDS
///         the show time of frame N; it differs from the tick after frame N - 1 (ticks were missed), or it is
///         the last frame. Increases from line to line; the frames after N follow at 1/rate again
///     load N SECONDS
///         the Nth file that the show loaded was not ready when it was due and took effect at this show time
///     order N ACTION VALUE
///         from frame N on: black 0|1, test-pattern 0|1, swap-eyes 0|1, eye-separation METRES or volume 0..1
///
///     relief N LOAD POSITION LEVEL
///         from frame N on the node at that position of that load applies that level of its degradation
///         ladder (see cost_budget.h); 0 = no degradation
///     stress N LEVEL
///         from frame N on all distances count 2^(LEVEL/4) times, when levels of detail are chosen
///
/// A tracker may jump between two records (tracker_jump.h): it was taken for another, or lost. Until the
/// later record it stays where it was. (A fast swing starts and ends over several records, and is no leap.)
///
/// Between two records poses and axes are interpolated, buttons are those of the earlier record. An eased way
/// is eased at whole multiples of 5 ms of show time and straight between them. Before the first record the
/// first is held, after the last one the last.
///
/// Frames, units  see input_sample.h.
/// Threads        a log that no thread changes may be read from any thread.
/// Errors         reading collects them with line and column; a log with errors is not returned.

#include "engine/base/diagnostic.h"
#include "engine/input/input_device.h"
#include "engine/input/run_decisions.h"

#include <optional>

namespace stadion {

/// A record of a tracker.
struct InputStamp {
  Nanoseconds time = 0;
  Pose X_RT;
  std::uint32_t buttons = 0;
  std::array<float, kTrackerAxes> axes{};
  bool valid = true;
  bool controlsOnly = false;  ///< buttons and axes of a device without a pose, which is not valid
  bool smooth = false;        ///< the way here from the stamp before is eased
};

struct InputTrack {
  std::string name;
  std::vector<InputStamp> stamps;  ///< strictly increasing time, never empty
};

struct InputLog {
  static constexpr std::size_t kMaxTrackers = 64;

  std::vector<InputTrack> tracks;  ///< in the order of first appearance
  RunDecisions decisions;          ///< decisions of the recorded run

  const InputTrack* find(std::string_view name) const;
  /// The time of the last record of a tracker, or of the last frame that was decided [ns].
  Nanoseconds end() const;
  /// Fills `sample` with the input at `showTime`. At the time of a stamp, these are exactly the stamp's
  /// values.
  void sampleAt(Nanoseconds showTime, InputSample& sample) const;
  /// Fills `sample` with the input at `end`, and with the corners of every tracker's path between `start` and
  /// `end`. The corners lie on the log's own time axis, so the path does not depend on the frames.
  void sampleFrame(Nanoseconds start, Nanoseconds end, InputSample& sample) const;
};

std::optional<InputLog> parseInputLog(std::string_view text, const std::string& file, Diagnostics& out);
std::optional<InputLog> loadInputLog(const std::string& path, Diagnostics& out);

/// Text that parseInputLog reads back to the very same values.
std::string formatInputLog(const InputLog& log);

/// Returns a record as a line of the format, with its newline.
std::string formatRecord(const std::string& tracker, const InputStamp& stamp);
/// The first line of a log; with a rate, the first two.
std::string inputLogHeading(double rate = 0);
std::string formatFrameTime(std::uint64_t frame, Nanoseconds time);
std::string formatLateLoad(std::uint32_t load, Nanoseconds time);
std::string formatOrder(std::uint64_t frame, const OperatorCommand& order);
std::string formatDegradation(std::uint64_t frame, const DegradationDecision& decision);

/// Plays a log.
class InputReplay final : public InputDevice {
public:
  explicit InputReplay(InputLog log) : log_(std::move(log)) {}

  using InputDevice::sampleAt;
  void sampleAt(Nanoseconds showTime, InputSample& sample) override { log_.sampleAt(showTime, sample); }
  void sampleFrame(Nanoseconds start, Nanoseconds end, InputSample& sample) override {
    log_.sampleFrame(start, end, sample);
  }
  Nanoseconds end() const override { return log_.end(); }
  const InputLog& log() const { return log_; }

private:
  InputLog log_;
};

}  // namespace stadion
