#pragma once
/// Scenes that are many and long: with a sanitizer each takes fifty times as long, so that only some are
/// played.

namespace stadion {

/// Whether the n-th of them is played.
constexpr bool isPlayed([[maybe_unused]] int n) {
#ifdef STADION_SANITIZED
  return n % 7 == 0;
#else
  return true;
#endif
}

}  // namespace stadion
