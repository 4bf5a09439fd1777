#pragma once
/// Writes a WAV file of any number of channels while it grows: 24 bits, WAVE_FORMAT_EXTENSIBLE, without places
/// of loudspeakers. A file of more than 4 GiB becomes an RF64 file.
///
/// Units    samples from -1 to 1; what is beyond is clipped and counted.
/// Threads  one at a time.
/// Errors   finish() reports the first one; then there is no file (AtomicFile).
/// Sources  Microsoft, "Multiple channel audio data and WAVE files", 2007; EBU Tech 3306, "RF64", 2009.

#include "engine/base/atomic_file.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace stadion {

class WaveFile {
public:
  WaveFile(std::string path, std::uint32_t channels, std::uint32_t rate);

  /// Whole frames, interleaved.
  void write(std::span<const float> samples);
  /// Completes the file. Nothing if all went well.
  std::optional<Diagnostic> finish();

  /// Returns the number of samples that were clipped.
  std::uint64_t clipped() const { return clipped_; }

private:
  std::string header() const;

  AtomicFile file_;
  std::uint32_t channels_, rate_;
  std::uint64_t bytes_ = 0, clipped_ = 0;
  std::vector<char> packed_;
};

}  // namespace stadion
