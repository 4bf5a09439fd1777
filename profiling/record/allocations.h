#pragma once
/// Counts a thread's allocations and their bytes since it began. It replaces operator new by one that counts;
/// allocations of C libraries are not counted. Blocks of 2 MiB and more lie on large pages where the system has them
/// ("transparent huge pages"): shadow maps and pictures are filled, and shadows looked up, in less time.
///
/// Off    in builds with sanitizers, which have an operator new of their own: always 0.
/// Cost   two additions to the thread's own memory and one to the process's, even if the counts are not read.
///
/// Threads  each reads its own counts; the count of all threads is for any thread.

#include <cstdint>

namespace stadion {

struct Allocations {
  std::uint64_t count = 0, bytes = 0;

  Allocations operator-(const Allocations& then) const { return {count - then.count, bytes - then.bytes}; }
  Allocations& operator+=(const Allocations& more) {
    count += more.count;
    bytes += more.bytes;
    return *this;
  }
};

/// Returns the counts of the calling thread.
Allocations allocationsSoFar();
/// Returns the number of allocations of all threads of this process.
std::uint64_t allocationsOfAllThreads();
/// Returns true if this build counts.
bool countsAllocations();

}  // namespace stadion
