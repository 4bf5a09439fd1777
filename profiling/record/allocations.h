#pragma once
/// How often a thread asked for memory, and for how much, since it began: with operator new, which this
/// replaces by one that counts. What C libraries allocate is not counted.
///
/// Off    in builds with sanitizers, which have an operator new of their own: always 0.
/// Cost   two additions to the thread's own memory and one to the process's, whether or not anybody asks.
///
/// Threads  each its own counts; that of all of them is for any thread.

#include <cstdint>

namespace stadion {

struct Allocations {
  std::uint64_t count = 0, bytes = 0;

  Allocations operator-(const Allocations& then) const { return {count - then.count, bytes - then.bytes}; }
  Allocations& operator+=(const Allocations& more) {
    count += more.count, bytes += more.bytes;
    return *this;
  }
};

/// Of the calling thread.
Allocations allocationsSoFar();
/// How often any thread of this process asked.
std::uint64_t allocationsOfAllThreads();
/// Whether this build counts.
bool countsAllocations();

}  // namespace stadion
