#pragma once
/// Scenes that are many and long: `--full` plays all of them, and another run two of five. With a sanitizer
/// each takes fifty times as long, so that only some are played.

#include <cstdlib>

namespace stadion {

/// Whether the n-th of them is played.
inline bool isPlayed(int n) {
#ifdef STADION_SANITIZED
  return n % 7 == 0;
#else
  static const bool all = std::getenv("STADION_FULL") != nullptr;
  return all || n % 5 < 2;
#endif
}

}  // namespace stadion
