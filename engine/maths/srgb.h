#pragma once
/// Between sRGB values, as pictures and scripts have them, and linear light (IEC 61966-2-1).
///
/// Shapes   one channel, 0 to 1; what is brighter than 1 follows the same curve.

#include "engine/maths/functions.h"

namespace stadion {

inline double linearFromSrgb(double c) {
  return c <= 0.04045 ? c / 12.92 : det::pow((c + 0.055) / 1.055, 2.4);
}

inline double srgbFromLinear(double c) {
  return c <= 0.0031308 ? 12.92 * c : 1.055 * det::pow(c, 1 / 2.4) - 0.055;
}

}  // namespace stadion
