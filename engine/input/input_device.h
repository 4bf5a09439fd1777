#pragma once
/// Where input comes from: a recorded log, a script, live trackers.
///
/// Threads  App calls sampleFrame(), once a frame and with increasing time; a live device fills its samples
///          on a thread of its own and answers from what has arrived.
/// Errors   a device that has nothing yet answers with trackers that are not valid; it never waits.

#include "engine/input/input_sample.h"

#include <optional>

namespace stadion {

/// A head, and what it is known by.
struct HeadNow {
  Pose X_RH;
  Nanoseconds measured = 0;  ///< as TrackerSample has it
};

class InputDevice {
public:
  virtual ~InputDevice() = default;

  /// The input at `showTime`. The sample is refilled, so that a caller who keeps it allocates nothing.
  virtual void sampleAt(Nanoseconds showTime, InputSample& sample) = 0;

  /// The same for a frame from `start` to `end`, with the corners of the trackers' ways inside it. A device
  /// that does not know them says where they are at the end.
  virtual void sampleFrame(Nanoseconds start, Nanoseconds end, InputSample& sample) {
    (void)start;
    sampleAt(end, sample);
  }

  InputSample sampleAt(Nanoseconds showTime) {
    InputSample sample;
    sampleAt(showTime, sample);
    return sample;
  }

  /// What it says at this moment, while show time stands still: for the pictures alone. False: as before.
  virtual bool sampleNow(InputSample& sample) {
    (void)sample;
    return false;
  }
  /// The head as it will be so long from now [ns], by what its tracker has said until now: for pictures that
  /// are about to be drawn. On any thread, also while App samples. Nothing: a frame's sample is all there is.
  virtual std::optional<HeadNow> headSoon(Nanoseconds ahead) {
    (void)ahead;
    return {};
  }
  /// From the next sample on the head is told as it will be so much later [ns], when its picture is seen (see
  /// forecast.h). Before a frame.
  virtual void aimHead(Nanoseconds ahead) { (void)ahead; }
  /// The head stays where it is, or is let go. Before a frame.
  virtual void freezeHead(bool frozen) { (void)frozen; }
  /// The show begins again: its times count from 0. Before the first frame.
  virtual void restart() {}

  /// When it has no more to say [ns]; 0 = never.
  virtual Nanoseconds end() const { return 0; }

protected:
  InputDevice() = default;
  InputDevice(const InputDevice&) = default;
  InputDevice& operator=(const InputDevice&) = default;
};

}  // namespace stadion
