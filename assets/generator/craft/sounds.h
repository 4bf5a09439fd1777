#pragma once
/// The show's own sounds: mono, 22050 samples a second, made of noise and sines, the same on every machine.

#include <cstdint>
#include <string>
#include <vector>

namespace stadion::assets {

using Samples = std::vector<double>;  ///< from -1 to 1

constexpr int kSoundRate = 22050;  ///< [1/s]

Samples wind();         ///< 4 s that repeat without a seam
Samples cheer();        ///< a crowd rejoices
Samples trumpetCall();  ///< the call of a salpinx, three notes
Samples thud();         ///< something heavy lands
Samples whoosh();       ///< something flies past

/// The bytes of a WAV file, PCM 16-bit.
std::string toWav(const Samples& samples);

}  // namespace stadion::assets
