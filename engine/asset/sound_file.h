#pragma once
/// Sound files: their lengths and their samples.
///
/// WAV, AIFF, FLAC and Ogg Vorbis, through libsndfile. A show needs the length alone, which is a count of
/// samples and so exact; only the sound player needs the samples.
///
/// Threads  free functions, any thread.
/// Errors   one sentence with the file's name; hostile files included.

#include "engine/base/diagnostic.h"
#include "engine/base/time_signature.h"

#include <cstdint>
#include <string>
#include <vector>

namespace stadion {

struct SoundInfo {
  std::uint64_t samples = 0;   ///< number of samples of one channel
  std::uint32_t rate = 0;      ///< samples a second [1/s]
  std::uint32_t channels = 0;  ///< 1 or 2

  /// [ns], rounded to the nearest one.
  Nanoseconds length() const;
};

struct Sound {
  SoundInfo info;
  std::vector<std::int16_t> samples;  ///< (samples x channels), interleaved
};

/// Returns the length and format of the open file, which is left open; `path` is its name in messages.
Result<SoundInfo> readSoundInfo(int file, const std::string& path);
Result<Sound> readSound(int file, const std::string& path);

/// Replaces a file that cannot be read: silence of this length [ns].
constexpr Nanoseconds kSilentStandIn = 1'000'000'000;

}  // namespace stadion
