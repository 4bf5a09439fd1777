#pragma once
/// Writes the devices' input to an input log, frame by frame.
///
/// Replaying the log at the same times gives the same samples to the bit; changes inside a frame are written
/// as records of their own.
///
/// Ownership  owns the file, which gets its name only with commit(). Without it no file is left, unless the
///            process is killed.
/// Threads    one thread.
/// Errors     Kept until commit(): a full disk does not end the show, and the complete records are kept as
///            PATH.partial, a log of its own. A tracker that is not valid, or with a pose that is not finite,
///            is recorded as lost. A pose with an inexact rotation is normalised. A sample not later than the
///            tracker's last one is left out.

#include "engine/base/atomic_file.h"
#include "engine/input/input_log.h"

#include <map>

namespace stadion {

class InputRecorder {
public:
  /// With a rate, decisions of the run are recorded as well.
  explicit InputRecorder(const std::string& path, double rate = 0);

  /// Returns why recording is impossible, known from the start: the file cannot be written.
  const std::optional<Diagnostic>& refusal() const { return file_.error(); }

  void record(const InputSample& sample);
  /// Takes every frame's signature, in order, and writes it if it is not on the next tick.
  void frame(const TimeSignature& now);
  /// Load `number` came late and took effect at `time`.
  void lateLoad(std::uint32_t number, Nanoseconds time);
  /// Records an operator's command about pictures and sounds, from frame `frame` on.
  void order(std::uint64_t frame, const OperatorCommand& order);
  /// Finishes the file; returns nothing on success.
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
