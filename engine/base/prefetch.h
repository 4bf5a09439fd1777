#pragma once
/// Requests memory before it is needed. Otherwise a loop over data that other threads have driven out of the
/// cache waits for every line of it.
///
/// Threads  any. It changes nothing and may point anywhere.

#include <cstddef>

namespace stadion {

constexpr std::size_t kCacheLine = 64;

/// All lines of an object that will be read, and perhaps written.
template <class T>
inline void prefetch(const T* object) {
  const auto* at = reinterpret_cast<const char*>(object);
  for (std::size_t line = 0; line < sizeof(T); line += kCacheLine) __builtin_prefetch(at + line, 1);
}

}  // namespace stadion
