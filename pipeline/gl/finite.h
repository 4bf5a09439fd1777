#pragma once
/// What a graphics card is given is finite.

#include <cmath>

namespace stadion {

/// Zero for what is not finite.
inline float finite(float x) {
  return std::isfinite(x) ? x : 0.0f;
}

}  // namespace stadion
