#pragma once
/// Where the samples of a pixel lie: in each row and column of a grid of as many lines there is one.

#include "pipeline/cpu_draw/kernels/kernel_data.h"

#include <array>

namespace stadion {

/// From the lower left of the pixel [pixels].
inline std::array<float, 2> samplePlace(int samples, int sample) {
  const int* place = samples == 1   ? kOneSample[0]
                     : samples == 2 ? kTwoSamples[sample]
                     : samples == 4 ? kFourSamples[sample]
                                    : kEightSamples[sample];
  const float part = 1 / static_cast<float>(2 * samples);
  return {static_cast<float>(place[0]) * part, static_cast<float>(place[1]) * part};
}

}  // namespace stadion
