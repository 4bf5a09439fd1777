#pragma once
/// What this process has of the machine at the moment.
///
/// Threads  free function, any thread. It reads /proc, some tens of microseconds.

#include <cstddef>
#include <cstdint>

namespace stadion {

struct ProcessFigures {
  std::uint64_t residentBytes = 0;  ///< memory that is there (RSS)
  std::uint64_t heapBytes = 0;      ///< of it, what the program has asked for and not given back
  std::size_t handles = 0;          ///< open file descriptors
  std::size_t threads = 0;
};

ProcessFigures processFigures();

}  // namespace stadion
