#pragma once
/// A growable piece of memory that other processes can map.
///
/// The whole address range is reserved at the start, so growing never moves data and does not disturb
/// readers.
///
/// Ownership  unmaps and closes on destruction.
/// Threads    growTo() from one thread at a time; reading older content is safe meanwhile.

#include <cstddef>
#include <memory>

namespace stadion {

class SharedSegment {
public:
  /// Throws std::bad_alloc if the system refuses (address space or file limit).
  SharedSegment(const char* name, std::size_t reserveBytes);
  /// Maps the segment of another process and takes over its descriptor. Only that process lets it grow.
  /// Memory beyond its end must not be touched.
  enum class Access { Read, Write };
  SharedSegment(int descriptor, std::size_t reserveBytes, Access access);
  ~SharedSegment();
  SharedSegment(const SharedSegment&) = delete;
  SharedSegment& operator=(const SharedSegment&) = delete;

  std::byte* data() const { return data_; }
  std::size_t size() const { return size_; }
  int descriptor() const { return descriptor_; }  ///< for another process that maps it

  /// Grows to at least `bytes`; new bytes are zero. Throws std::bad_alloc beyond the reservation.
  void growTo(std::size_t bytes);
  /// Returns the pages wholly inside [offset, offset + bytes) to the system; they read as zero afterwards.
  void discard(std::size_t offset, std::size_t bytes);

private:
  std::byte* data_ = nullptr;
  std::size_t size_ = 0, reserve_ = 0;
  int descriptor_ = -1;
};

}  // namespace stadion
