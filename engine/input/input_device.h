#pragma once
/// A source of input: a recorded log, a script, live trackers.
///
/// Threads  App calls sampleFrame(), once a frame and with increasing time; a live device fills its samples
///          on a thread of its own and answers from the data that has arrived.
/// Errors   a device without data answers with trackers that are not valid; it never waits.

#include "engine/input/input_sample.h"

#include <optional>

namespace stadion {

/// A head pose and its times.
struct HeadNow {
  Pose X_RH;
  Nanoseconds measured = 0;  ///< as TrackerSample has it
};

class InputDevice {
public:
  virtual ~InputDevice() = default;

  /// Returns the input at `showTime`. The sample is refilled, so a caller that keeps it allocates nothing.
  virtual void sampleAt(Nanoseconds showTime, InputSample& sample) = 0;

  /// Returns the input for a frame from `start` to `end`, with the corners of the trackers' paths inside it.
  /// A device that does not know them reports its trackers' poses at the end.
  virtual void sampleFrame(Nanoseconds start, Nanoseconds end, InputSample& sample) {
    (void)start;
    sampleAt(end, sample);
  }

  InputSample sampleAt(Nanoseconds showTime) {
    InputSample sample;
    sampleAt(showTime, sample);
    return sample;
  }

  /// Returns the input at this moment while show time stands still, for the pictures alone. False: unchanged.
  virtual bool sampleNow(InputSample& sample) {
    (void)sample;
    return false;
  }
  /// Predicts the head for `ahead` from now [ns], from its tracker's data until now, for pictures that are
  /// about to be drawn. On any thread, also while App samples. Returns nothing if the device knows only a
  /// frame's sample.
  virtual std::optional<HeadNow> headSoon(Nanoseconds ahead) {
    (void)ahead;
    return {};
  }
  /// From the next sample on, the head is predicted by this much [ns], for the time at which its picture is
  /// seen (see forecast.h). Call it before a frame.
  virtual void aimHead(Nanoseconds ahead) { (void)ahead; }
  /// Freezes the head, or releases it. Call it before a frame.
  virtual void freezeHead(bool frozen) { (void)frozen; }
  /// Restarts: the show's times count from 0 again. Call it before the first frame.
  virtual void restart() {}

  /// Returns the end of its input [ns]; 0 = none.
  virtual Nanoseconds end() const { return 0; }

protected:
  InputDevice() = default;
  InputDevice(const InputDevice&) = default;
  InputDevice& operator=(const InputDevice&) = default;
};

}  // namespace stadion
