#pragma once
/// Adds the operator's cues to a show's input: each cue is a button of a tracker named `operator`, which is pressed for
/// one frame.
///
/// So a called cue travels the way of all input: it is recorded, replayed and sent to the hosts of a cluster. The
/// samples are those of an input log with one record a frame. So a log that InputRecorder wrote gives the very same
/// samples again.
///
/// If the device inside has an `operator` itself, such as a log, both count.
///
/// Ownership  borrows the device inside.
/// Threads    call() from any; the rest as InputDevice has it.

#include "engine/input/input_device.h"
#include "engine/input/input_log.h"

#include <atomic>
#include <cstdint>

namespace stadion {

class OperatorDevice final : public InputDevice {
public:
  static constexpr std::uint32_t kMostCues = 32;

  explicit OperatorDevice(InputDevice& inner);

  void readFrom(InputDevice& inner) { inner_ = &inner; }
  /// Presses the cue's button in the next frame. A second call in one frame means the same call. False: there is no
  /// such number.
  bool call(std::uint32_t cue);

  using InputDevice::sampleAt;
  void sampleAt(Nanoseconds showTime, InputSample& sample) override {
    sampleFrame(showTime, showTime, sample);
  }
  void sampleFrame(Nanoseconds start, Nanoseconds end, InputSample& sample) override;
  bool sampleNow(InputSample& sample) override { return inner_->sampleNow(sample); }
  std::optional<HeadNow> headSoon(Nanoseconds ahead) override { return inner_->headSoon(ahead); }
  void aimHead(Nanoseconds ahead) override { inner_->aimHead(ahead); }
  void freezeHead(bool frozen) override { inner_->freezeHead(frozen); }
  void restart() override;
  Nanoseconds end() const override { return inner_->end(); }

private:
  void press(Nanoseconds time);

  InputDevice* inner_;
  std::atomic<std::uint32_t> called_ = 0;  ///< cues that wait for the next frame, one bit each
  InputLog log_;                           ///< of the last frames
  InputSample own_;
};

}  // namespace stadion
