#pragma once
/// Ensures that a graphics card gets only finite numbers.

#include <cmath>

namespace stadion {

/// Returns zero for a number that is not finite.
inline float finite(float x) {
  return std::isfinite(x) ? x : 0.0f;
}

}  // namespace stadion
