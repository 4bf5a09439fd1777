#pragma once
/// Input written by a program: key poses per tracker. (People write `key` records in a log, input_log.h.)
///
///     ScriptedInput visitor;
///     visitor.key("head", 0, {0, 0, 1.7}).key("foot", 1, {0, 0, 0.1})
///         .key("foot", 1.25, {0, 0.8, 0.3}, {25, 0, 0});
///
/// Frames, units  see input_sample.h; times in seconds, angles in degrees (about the rig's X, then Y,
///                then Z).
/// Threads        built by one thread, then used as any device.
/// Errors         a key that is not later than the tracker's last one, or not finite, is refused (add() is
///                false) and changes nothing.

#include "engine/input/input_log.h"

namespace stadion {

class ScriptedInput final : public InputDevice {
public:
  bool add(const std::string& tracker, const InputStamp& stamp);
  /// add() of a pose, for chains of calls; `smooth` eases the way here.
  ScriptedInput& key(const std::string& tracker, double seconds, const Vec3& p_RT,
                     const Vec3& turn = Vec3::Zero(), bool smooth = false, std::uint32_t buttons = 0);

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
