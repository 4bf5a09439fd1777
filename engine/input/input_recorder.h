#pragma once
/// Writes what the devices say to an input log, frame by frame.
///
/// Replaying the log at the same times gives the same samples to the bit; what happened inside a frame is
/// written as records of its own.
///
/// Ownership  owns the file, which appears under its name only with commit(); without it nothing is left
///            behind, unless the process is killed.
/// Threads    one thread.
/// Errors     kept until commit(): a full disk does not end the show, and what could be written is kept as
///            PATH.partial, a log of its own. A tracker that is not
///            valid or whose pose is not finite is recorded as lost; a pose out of true is normalised; a
///            sample that is not later than the tracker's last one is left out.

#include "engine/base/atomic_file.h"
#include "engine/input/input_log.h"

#include <map>

namespace stadion {

class InputRecorder {
public:
  /// With a rate, what a clock decides is recorded as well.
  explicit InputRecorder(const std::string& path, double rate = 0);

  /// Why nothing can be recorded, known as soon as it is made: the file cannot be written.
  const std::optional<Diagnostic>& refusal() const { return file_.error(); }

  void record(const InputSample& sample);
  /// Every frame's signature, in order: written down where it is not on the tick after the last one.
  void frame(const TimeSignature& now);
  /// Load `number` came late and took effect at `time`.
  void lateLoad(std::uint32_t number, Nanoseconds time);
  /// The operator asked for something that changes pictures and sounds, from frame `frame` on.
  void order(std::uint64_t frame, const OperatorCommand& order);
  /// Finishes the file; nothing if all went well.
  std::optional<Diagnostic> commit();

private:
  struct Last {
    Nanoseconds time = -1;
    bool valid = true;        ///< there was a pose
    bool hasControls = true;  ///< there were buttons and axes, with a pose or without
    std::uint32_t buttons = 0;
    std::array<float, kTrackerAxes> axes{};
  };
  void record(const TrackerSample& tracker, Nanoseconds time);
  void recordKnot(TrackerSample tracker, const PoseKnot& knot, Nanoseconds end);
  void recordControls(TrackerSample tracker, Nanoseconds end);
  void write(const TrackerSample& tracker, Nanoseconds time);

  AtomicFile file_;
  double rate_;
  std::optional<FrameClock> expected_;
  TimeSignature lastFrame_;
  bool lastIsWritten_ = true;
  std::map<std::string, Last> last_;
};

}  // namespace stadion
