#pragma once
/// A growable piece of this process's memory, on large pages if the system has them. A reader of thousands of
/// records a frame would otherwise spend much of its time on address translation, because other threads have
/// used the processor in between.
///
/// The whole address range is reserved at the start, so growing never moves data and does not disturb
/// readers.
///
/// Ownership  unmaps on destruction.
/// Threads    growTo() from one thread at a time; reading older content is safe meanwhile.

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
  /// Grows to at least `bytes`; new bytes are zero. Throws std::bad_alloc beyond the reservation.
  void growTo(std::size_t bytes) const;

private:
  void* mapped_ = nullptr;
  std::size_t mappedBytes_ = 0, reserve_ = 0;
  std::byte* data_ = nullptr;  ///< in mapped_, at the start of a large page
};

}  // namespace stadion
