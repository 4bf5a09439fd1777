#pragma once
/// Whether something grows, from samples of a long run: memory, handles, threads.
///
/// Samples come from one process or, where a run was taken up again, from several: each has memory of its
/// own. In a process a show is opened again and again, each time a visit: where memory lies then is new.
///
/// Threads  plain values.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace stadion {

struct SoakSample {
  std::uint32_t process = 0;  ///< which of the processes that played
  std::uint64_t visit = 0;    ///< which time that a show was opened
  std::uint64_t frame = 0;    ///< of the whole soak
  std::uint64_t residentBytes = 0, heapBytes = 0;
  std::uint64_t handles = 0, threads = 0;
};

/// Those of each visit that were taken once it had played `frames` frames.
std::vector<SoakSample> afterWarmUp(std::span<const SoakSample> samples, std::uint64_t frames);

/// The middle one of the slopes between any two samples of a visit (Theil and Sen), so that no outliers and
/// no steps of the allocator decide [of the figure, a frame]. Nothing if there are not two.
std::optional<double> slopeOf(std::span<const SoakSample> samples, std::uint64_t SoakSample::*figure);

/// Likewise from visit to visit of a process, by each one's last sample [of the figure, a visit]. Nothing
/// unless a process had ten.
std::optional<double> slopeOfVisits(std::span<const SoakSample> samples, std::uint64_t SoakSample::*figure);

/// By how much the highest figure of each process' later half is above that of its earlier half, at most.
std::int64_t growthOf(std::span<const SoakSample> samples, std::uint64_t SoakSample::*figure);

}  // namespace stadion
