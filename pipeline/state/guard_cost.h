#pragma once
/// The cost of the write guard.
///
/// Threads  after the last open() and close() of the guard.

#include <cstdint>

namespace stadion {

struct GuardCost {
  std::uint64_t calls = 0;  ///< calls that changed the protection of a range
  double milliseconds = 0;  ///< the time of these calls [ms]
};

/// Of the guard that exists, or else of the last one.
GuardCost costOfGuard();

}  // namespace stadion
