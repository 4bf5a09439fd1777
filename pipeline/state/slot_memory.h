#pragma once
/// A growable piece of this process's memory, on large pages where the system has them: who goes through
/// thousands of records once a frame, after others have had the processor, would else spend much of his time
/// on finding out where their pages are.
///
/// The whole address range is reserved at the start, so growing never moves anything and readers are not
/// disturbed.
///
/// Ownership  unmaps on destruction.
/// Threads    growTo() from one thread at a time; reading what was there before is safe meanwhile.

#include <cstddef>

namespace stadion {

class SlotMemory {
public:
  /// Throws std::bad_alloc if the system refuses.
  explicit SlotMemory(std::size_t reserveBytes);
  ~SlotMemory();
  SlotMemory(const SlotMemory&) = delete;
  SlotMemory& operator=(const SlotMemory&) = delete;

  std::byte* data() const { return data_; }
  /// At least `bytes`; new bytes are zero. Throws std::bad_alloc beyond the reservation.
  void growTo(std::size_t bytes) const;

private:
  void* mapped_ = nullptr;
  std::size_t mappedBytes_ = 0, reserve_ = 0;
  std::byte* data_ = nullptr;  ///< in mapped_, where a large page begins
};

}  // namespace stadion
