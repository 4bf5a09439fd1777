#pragma once
/// Where sounds come out: OpenAL Soft, loaded when the first sound plays; nothing is linked.
///
/// Frames   the head's: +X to its right, +Y the way it looks, +Z up [m].
/// Threads  one thread makes and uses it.
/// Errors   a device that cannot play a sound leaves it out; the show does not depend on it.

#include "engine/asset/sound_file.h"
#include "engine/maths/maths.h"

#include <memory>
#include <string>

namespace stadion {

class SoundDevice {
public:
  using Voice = std::uint32_t;

  virtual ~SoundDevice() = default;
  /// What it calls itself.
  virtual std::string name() const = 0;
  /// Plays the sound from `offset` [s] on, silently until its first set(). 0 if it cannot.
  virtual Voice start(const Sound& sound, bool loop, double offset) = 0;
  /// How loud (0 to 1) and from where; at the origin it comes from everywhere.
  virtual void set(Voice voice, double gain, const Vec3& p_H) = 0;
  virtual void stop(Voice voice) = 0;
  /// Of a voice; it goes on where it was.
  virtual void pause(Voice voice, bool paused) = 0;
  /// Of all of them, from 0 to 1.
  virtual void setVolume(double volume) = 0;
};

/// The system's standard output. Fails, with what to install, if there is none.
Result<std::unique_ptr<SoundDevice>> openSoundDevice();

}  // namespace stadion
