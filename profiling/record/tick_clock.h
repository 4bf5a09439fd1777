#pragma once
/// A clock that is very cheap to read, for spans that are mostly too short to matter. It uses the processor's
/// counter if there is one, in a unit of its own.
///
/// Threads  any.

#include <chrono>
#include <cstdint>

namespace stadion {

struct TickClock {
#if defined(__x86_64__)
  static std::uint64_t now() {
    return __builtin_ia32_rdtsc();
  }
#else
  static std::uint64_t now() {
    return static_cast<std::uint64_t>(std::chrono::steady_clock::now().time_since_epoch().count());
  }
#endif
};

}  // namespace stadion
