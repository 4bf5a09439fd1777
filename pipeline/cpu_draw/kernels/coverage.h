#pragma once
/// Which samples a triangle covers, and which of these are nearest.
///
/// Rule     In a row a triangle covers the samples from its left border on and before its right one, from its
///          lowest corner on and below its highest one. So of two triangles with a common edge exactly one
///          covers a sample on it.
/// Linkage  internal.

#include "pipeline/cpu_draw/kernels/kernel_data.h"
#include "pipeline/cpu_draw/kernels/lanes.h"

namespace stadion {
namespace {

template <class By, int kSamples>
struct Coverage : DrawLanes<By> {
  using L = DrawLanes<By>;
  using F = typename L::F;
  using I = typename L::I;
  static constexpr int kLanes = By::kLanes;
  static constexpr int kParts = kSamples > kLanes ? kSamples / kLanes : 1;   ///< vectors of a pixel
  static constexpr int kPixels = kSamples > kLanes ? 1 : kLanes / kSamples;  ///< pixels of a vector

  static constexpr const int (*places())[2] {
    if constexpr (kSamples == 1)
      return kOneSample;
    else if constexpr (kSamples == 2)
      return kTwoSamples;
    else if constexpr (kSamples == 4)
      return kFourSamples;
    else
      return kEightSamples;
  }

  /// Where the samples of a step lie: relative to its first pixel, and to its row.
  struct Pattern {
    F x[kParts], y[kParts];
  };
  [[gnu::always_inline]] static inline Pattern pattern() {
    Pattern p;
    for (int part = 0; part < kParts; ++part)
      for (int lane = 0; lane < kLanes; ++lane) {
        const int sample = part * kLanes + lane, pixel = sample / kSamples;
        const int* place = places()[sample % kSamples];
        p.x[part][lane] = static_cast<float>(pixel) + static_cast<float>(place[0]) / (2 * kSamples);
        p.y[part][lane] = static_cast<float>(place[1]) / (2 * kSamples);
      }
    return p;
  }

  /// A triangle's row: its samples lie in [from, to), their depth is depthX * x + depth.
  struct Row {
    F from[kParts], to[kParts], depth[kParts];
  };
  [[gnu::always_inline]] static inline Row row(const TriangleRecord& t, const Pattern& p, int y) {
    Row out;
    const float grown = (t.sourceAndFlags & kGrown) != 0 ? 1.0f / 256 : 0.0f;
    for (int part = 0; part < kParts; ++part) {
      const F at = static_cast<float>(y) + p.y[part];
      const F up = at - t.y0;
      const F longEdge = t.x0 + up * t.slopeLong;
      const F lowEdge = t.x0 + up * t.slopeLow, highEdge = t.x1 + (at - t.y1) * t.slopeHigh;
      const F shortEdge = L::select(at < t.y1, lowEdge, highEdge);
      const I there = (at >= t.y0) & (at < t.y2);
      const bool longLeft = (t.sourceAndFlags & kLongEdgeIsLeft) != 0;
      // Within the box, so that no kernel covers more than another because its vectors are wider.
      out.from[part] = L::most((longLeft ? longEdge : shortEdge) - grown, L::all(static_cast<float>(t.left)));
      const F to =
          L::least((longLeft ? shortEdge : longEdge) + grown, L::all(static_cast<float>(t.right + 1)));
      out.to[part] = L::select(there, to, L::all(-1));
      out.depth[part] = t.depthY * (static_cast<float>(y - t.low) + p.y[part]) + t.depth;
    }
    return out;
  }

  /// The pixels of a row that may be covered. Narrow triangles are not worth it.
  [[gnu::always_inline]] static inline bool narrow(const TriangleRecord& t, const Row& row, int& from,
                                                   int& to) {
    from = t.left / kPixels * kPixels;
    to = t.right;
    if (to - from <= 16) return true;
    float least = row.from[0][0], most = row.to[0][0];
    for (int part = 0; part < kParts; ++part)
      for (int lane = 0; lane < (kSamples < kLanes ? kSamples : kLanes); ++lane) {
        const float a = row.from[part][lane], b = row.to[part][lane];
        least = a < least ? a : least;
        most = b > most ? b : most;
      }
    if (!(least < most)) return false;
    if (least > static_cast<float>(from))
      from = static_cast<int>(least < 32767.0f ? least : 32767.0f) / kPixels * kPixels;
    if (most < static_cast<float>(to)) to = most > 0 ? static_cast<int>(most) : -1;
    return from <= to;
  }

  /// Calls `work(part, first sample in the row, covered, depth)` for the steps of a triangle in a band, and
  /// `next(x, y)` after each step.
  template <class Work, class Next>
  [[gnu::always_inline]] static inline void walk(const TriangleRecord& t, const Pattern& p, int low, int end,
                                                 const Work& work, const Next& next) {
    const int y0 = t.low > low ? t.low : low, y1 = t.high < end - 1 ? t.high : end - 1;
    for (int y = y0; y <= y1; ++y) {
      const Row r = row(t, p, y);
      int from, to;
      if (!narrow(t, r, from, to)) continue;
      for (int x = from; x <= to; x += kPixels) {
        const float at = static_cast<float>(x), right = static_cast<float>(x - t.left);
        for (int part = 0; part < kParts; ++part) {
          const F sample = at + p.x[part];
          const I inside = (sample >= r.from[part]) & (sample < r.to[part]);
          if (L::bits(inside) == 0) continue;
          const F depth = t.depthX * (right + p.x[part]) + r.depth[part];
          work(part, y, x * kSamples + part * kLanes, inside, L::least(depth, L::all(t.mostDepth)));
        }
        next(x, y);
      }
    }
  }

  [[gnu::always_inline]] static inline I holes(I covered, const int* present, int at) {
    return present ? covered & L::loadInts(present + at) : covered;
  }

  /// Without numbers of triangles if kDepthOnly.
  template <bool kDepthOnly>
  [[gnu::always_inline]] static inline void cover(const TriangleRecord* const* triangles, unsigned count,
                                                  unsigned first, const int* present,
                                                  const BandSamples& band) {
    const Pattern p = pattern();
    for (unsigned i = 0; i < count; ++i) {
      const I mine = I{} + static_cast<int>(first + i);
      walk(
          *triangles[i], p, band.low, band.end,
          [&](int, int y, int x, I covered, F depth) {
            const int at = (y - band.low) * band.stride + x;
            const F before = L::load(band.depth + at);
            const I passes = holes(covered, present, at) & (depth >= before);
            if (L::bits(passes) == 0) return;
            L::store(band.depth + at, L::select(passes, depth, before));
            if constexpr (!kDepthOnly)
              L::storeInts(band.triangle + at, By::select(passes, mine, L::loadInts(band.triangle + at)));
          },
          [](int, int) {});
    }
  }

  [[gnu::always_inline]] static inline unsigned coverLayer(const TriangleRecord& t, unsigned number,
                                                           const int* present, const BandSamples& band,
                                                           LayerFragment* out) {
    constexpr float kOnSurface =
        2e-6f;  // what lies on an opaque surface is seen, however its depth was rounded
    constexpr unsigned kPixel = (1U << kSamples) - 1;
    unsigned made = 0, passed = 0;
    walk(
        t, pattern(), band.low, band.end,
        [&](int part, int y, int x, I covered, F depth) {
          const int at = (y - band.low) * band.stride + x;
          const F opaque = L::load(band.depth + at);
          const I passes = holes(covered, present, at) & (depth >= opaque - kOnSurface * opaque);
          passed |= L::bits(passes) << (part * kLanes);
        },
        [&](int x, int y) {
          for (int k = 0; passed != 0; ++k, passed >>= kSamples)
            if (const unsigned samples = passed & kPixel; samples != 0)
              out[made++] = {static_cast<unsigned>(x + k) | static_cast<unsigned>(y) << 16, number, samples};
        });
    return made;
  }
};

}  // namespace
}  // namespace stadion
