#pragma once
/// Colours of pixels as bytes.
///
/// Linkage  internal.

#include "pipeline/cpu_draw/kernels/kernel_data.h"
#include "pipeline/cpu_draw/kernels/lanes.h"

namespace stadion {
namespace {

template <class By>
struct ColourEncoding : DrawLanes<By> {
  using L = DrawLanes<By>;
  using F = typename L::F;
  static constexpr int kLanes = By::kLanes;

  /// A value that is not a number becomes 0.
  [[gnu::always_inline]] static inline void scaled(const float* colours, float by, int* out) {
    const F within = L::least(L::most(L::load(colours), F{}), L::all(1));
    L::storeInts(out, L::truncated(by * within + 0.5f));
  }

  static void encode(const float* colours, unsigned count, const unsigned char* steps, unsigned char* out) {
    constexpr unsigned kPixels = kLanes / 4;
    alignas(64) int step[kLanes];
    const float by = steps ? static_cast<float>(kEncodedSteps) : 255.0f;
    for (unsigned i = 0; i < count; i += kPixels) {
      scaled(colours + 4 * i, by, step);
      for (unsigned k = 0; k < kPixels && i + k < count; ++k) {
        const int* from = step + 4 * k;
        const auto byteOf = [&](int c) {
          return steps ? static_cast<unsigned>(steps[from[c]]) : static_cast<unsigned>(from[c]);
        };
        const unsigned pixel = byteOf(0) | byteOf(1) << 8 | byteOf(2) << 16 | 0xffU << 24;
        __builtin_memcpy(out + 4 * (i + k), &pixel, 4);  // one store instead of four
      }
    }
  }
};

}  // namespace
}  // namespace stadion
