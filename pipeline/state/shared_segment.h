#pragma once
/// A growable piece of memory that other processes can map.
///
/// The whole address range is reserved at the start, so growing never moves anything and readers are not
/// disturbed. Ownership  unmaps and closes on destruction. Threads    growTo() from one thread at a time;
/// reading what was there before is safe meanwhile.

#include <cstddef>
#include <memory>

namespace stadion {

class SharedSegment {
public:
  /// Throws std::bad_alloc if the system refuses (address space or file limit).
  SharedSegment(const char* name, std::size_t reserveBytes);
  /// The segment of another process, whose descriptor it takes; only that process lets it grow. What lies
  /// beyond its end must not be touched.
  enum class Access { Read, Write };
  SharedSegment(int descriptor, std::size_t reserveBytes, Access access);
  ~SharedSegment();
  SharedSegment(const SharedSegment&) = delete;
  SharedSegment& operator=(const SharedSegment&) = delete;

  std::byte* data() const { return data_; }
  std::size_t size() const { return size_; }
  int descriptor() const { return descriptor_; }  ///< for a process that is to map it

  /// At least `bytes`; new bytes are zero. Throws std::bad_alloc beyond the reservation.
  void growTo(std::size_t bytes);
  /// Gives the pages wholly inside [offset, offset + bytes) back to the system; they read as zero afterwards.
  void discard(std::size_t offset, std::size_t bytes);

private:
  std::byte* data_ = nullptr;
  std::size_t size_ = 0, reserve_ = 0;
  int descriptor_ = -1;
};

}  // namespace stadion
