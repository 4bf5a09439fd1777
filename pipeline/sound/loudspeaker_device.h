#pragma once
/// Sound output to the loudspeakers of a hall: a SpeakerMixer, and a thread that writes what it mixes.
///
/// If the device goes away, the show goes on in silence, and the device is opened again as soon as it is back.
///
/// Threads  one thread makes and uses it; another one of its own mixes and writes.
/// Errors   openLoudspeakers() says why there is no device.

#include "engine/loudspeakers/loudspeaker.h"
#include "pipeline/sound/alsa_output.h"
#include "pipeline/sound/sound_device.h"

#include <functional>
#include <memory>

namespace stadion {

using OpenSpeakerOutput = std::function<Result<std::unique_ptr<SpeakerOutput>>()>;

/// Opens the hall's own device, or what `open` gives. Expects loudspeakers.
Result<std::unique_ptr<SoundDevice>> openLoudspeakers(const LoudspeakerSet& hall,
                                                      OpenSpeakerOutput open = {});

}  // namespace stadion
