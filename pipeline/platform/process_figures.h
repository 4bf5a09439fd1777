#pragma once
/// This process's current use of the machine.
///
/// Threads  free function, any thread. It reads /proc, which takes some tens of microseconds.

#include <cstddef>
#include <cstdint>

namespace stadion {

struct ProcessFigures {
  std::uint64_t residentBytes = 0;  ///< memory in use (RSS)
  std::uint64_t heapBytes = 0;      ///< memory that the program has allocated and not freed
  std::size_t handles = 0;          ///< open file descriptors
  std::size_t threads = 0;
};

ProcessFigures processFigures();

}  // namespace stadion
