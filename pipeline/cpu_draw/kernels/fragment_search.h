#pragma once
/// Fragments of the pixels of a row: which triangles their samples show.
///
/// Linkage  internal.

#include "pipeline/cpu_draw/kernels/kernel_data.h"
#include "pipeline/cpu_draw/kernels/lanes.h"

namespace stadion {
namespace {

template <class By, int kSamples>
struct FragmentFinder : DrawLanes<By> {
  using L = DrawLanes<By>;
  using I = typename L::I;
  static constexpr int kLanes = By::kLanes;

  /// Whether all samples of a run's pixels show one triangle.
  [[gnu::always_inline]] static inline bool alike(const unsigned* shown) {
    constexpr int kNumbers = kRunPixels * kSamples;
    if constexpr (kNumbers < kLanes) {
      unsigned differs = 0;
      for (int i = 1; i < kNumbers; ++i) differs |= shown[i] ^ shown[0];
      return differs == 0;
    }
    const I first = I{} + static_cast<int>(shown[0]);
    I differs{};
    for (int i = 0; i + kLanes <= kNumbers; i += kLanes) differs |= L::loadInts(shown + i) ^ first;
    return L::bits(differs != 0) == 0;
  }
  /// Whether all samples of a pixel do.
  [[gnu::always_inline]] static inline bool isWhole(const unsigned* shown) {
    unsigned differs = 0;
    for (int s = 1; s < kSamples; ++s) differs |= shown[s] ^ shown[0];
    return differs == 0;
  }

  [[gnu::always_inline]] static inline void add(FragmentSearch& row, FragmentList& to, unsigned shown, int x,
                                                unsigned place) {
    const unsigned number = shown < row.sky ? shown : row.sky;
    to.number[to.size] = number;
    to.place[to.size] = place;
    to.pixel[to.size++] = static_cast<unsigned>(row.x + x) | static_cast<unsigned>(row.y) << 16;
    ++to.times[number];
  }

  /// The triangles of a pixel, in the order of its samples.
  static void addParts(FragmentSearch& row, const unsigned* shown, int x) {
    constexpr float kShare = 1.0f / kSamples;
    const unsigned first = row.parts;
    for (unsigned left = (1U << kSamples) - 1; left != 0;) {
      const unsigned triangle = shown[__builtin_ctz(left)];
      unsigned same = 0, count = 0;
      for (int s = 0; s < kSamples; ++s) {
        const unsigned is = shown[s] == triangle;
        same |= is << s;
        count += is;
      }
      row.weight[row.parts] = kShare * static_cast<float>(count);
      add(row, *row.ones, triangle, x, row.firstPart + row.parts++);
      left &= ~same;
    }
    row.shared[row.sharedSize++] = {row.place + static_cast<unsigned>(x), first, row.parts - first};
  }

  static void find(FragmentSearch& row) {
    for (int x = 0; x < row.width;) {
      const unsigned* shown = row.shown + x * kSamples;
      if (x + kRunPixels <= row.width && alike(shown)) {
        add(row, *row.runs, shown[0], x, row.place + static_cast<unsigned>(x));
        x += kRunPixels;
        continue;
      }
      const int end = x + kRunPixels < row.width ? x + kRunPixels : row.width;
      for (; x < end; ++x, shown += kSamples) {
        if (isWhole(shown))
          add(row, *row.ones, shown[0], x, row.place + static_cast<unsigned>(x));
        else
          addParts(row, shown, x);
      }
    }
  }
};

}  // namespace
}  // namespace stadion
