#pragma once
/// Frames of sound for many channels, to an ALSA device. The library is loaded when it is opened; it is not linked.
///
/// A device of ALSA is a sound card ("hw:1"), a card with conversion ("plughw:1"), a sound server ("pipewire",
/// "default") or a file ("file:FILE,raw").
///
/// Units    frames at SpeakerMixer::kRate.
/// Threads  one at a time; write() waits for the device.
/// Errors   open() says why there is no device. write() repairs a device that has run dry, and returns false if
///          it has gone.
/// Sources  the ALSA library's PCM interface, 1.2.

#include "engine/base/diagnostic.h"

#include <cstdint>
#include <memory>
#include <span>
#include <string>

namespace stadion {

class SpeakerOutput {
public:
  virtual ~SpeakerOutput() = default;
  /// Writes whole frames, interleaved, -1 to 1; what is beyond is clipped. False: the device has gone.
  virtual bool write(std::span<const float> frames) = 0;
};

/// Opens a device for so many channels. An empty name is "default".
Result<std::unique_ptr<SpeakerOutput>> openAlsaOutput(const std::string& device, std::uint32_t channels);

}  // namespace stadion
