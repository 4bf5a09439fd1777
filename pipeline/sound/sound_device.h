#pragma once
/// Sound output: OpenAL Soft, loaded when the first sound plays; it is not linked. A hall with loudspeakers of its
/// own has another one (loudspeaker_device.h).
///
/// Frames   the head's: +X to its right, +Y the way it looks, +Z up [m]. Of a device that stands in the room: the
///          rig's axes, seen from the head.
/// Threads  one thread makes and uses it.
/// Errors   a sound that the device cannot play is left out; the show does not depend on it.

#include "engine/asset/sound_file.h"
#include "engine/maths/maths.h"

#include <memory>
#include <string>

namespace stadion {

class SoundDevice {
public:
  using Voice = std::uint32_t;

  virtual ~SoundDevice() = default;
  /// Returns the device's own name.
  virtual std::string name() const = 0;
  /// Returns true if its loudspeakers stand in the room, and do not turn with the head.
  virtual bool standsInRoom() const { return false; }
  /// Plays the sound from `offset` [s] on, silently until the first set(). Returns 0 if it cannot.
  virtual Voice start(const std::shared_ptr<const Sound>& sound, bool loop, double offset) = 0;
  /// Sets volume (0 to 1) and place. A sound at the origin comes from all directions.
  virtual void set(Voice voice, double gain, const Vec3& p_H) = 0;
  virtual void stop(Voice voice) = 0;
  /// Pauses a voice; later it continues from the same point.
  virtual void pause(Voice voice, bool paused) = 0;
  /// Sets the volume of all voices, from 0 to 1.
  virtual void setVolume(double volume) = 0;
};

/// Opens the system's standard output. Fails, with the package to install, if there is none.
Result<std::unique_ptr<SoundDevice>> openSoundDevice();

}  // namespace stadion
