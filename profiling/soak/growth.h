#pragma once
/// Detects growth in samples of a long run: memory, handles, threads.
///
/// Samples come from one process or, after an interruption, from several; each has memory of its own. A
/// process opens a show repeatedly; each opening is a visit, with new places in memory.
///
/// Threads  plain values.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace stadion {

struct SoakSample {
  std::uint32_t process = 0;  ///< number of the process
  std::uint64_t visit = 0;    ///< number of the opening of the show
  std::uint64_t frame = 0;    ///< number of the frame in the whole soak
  std::uint64_t residentBytes = 0, heapBytes = 0;
  std::uint64_t handles = 0, threads = 0;
};

/// Returns the samples of each visit that were taken after `frames` frames.
std::vector<SoakSample> afterWarmUp(std::span<const SoakSample> samples, std::uint64_t frames);

/// Returns the median slope between any two samples of a visit (Theil and Sen), which ignores outliers and
/// steps of the allocator [of the figure, a frame]. Returns nothing for fewer than two samples.
std::optional<double> slopeOf(std::span<const SoakSample> samples, std::uint64_t SoakSample::*figure);

/// Likewise between the visits of a process, by each one's last sample [of the figure, a visit]. Returns
/// nothing unless a process had ten visits.
std::optional<double> slopeOfVisits(std::span<const SoakSample> samples, std::uint64_t SoakSample::*figure);

/// Returns the greatest increase, over all processes, of the highest figure from the earlier to the later
/// half.
std::int64_t growthOf(std::span<const SoakSample> samples, std::uint64_t SoakSample::*figure);

}  // namespace stadion
