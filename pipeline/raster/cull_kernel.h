#pragma once
/// The functions of cull_kernels.h, for as many triangles at a time as F has lanes. Internal to
/// pipeline/raster/.
///
/// Linkage  internal; includes nothing but these two.

#include "pipeline/raster/cull_kernels.h"
#include "pipeline/raster/raster_lanes.h"

namespace stadion {
namespace {

template <class By>
struct TriangleCulling : Lanes<By> {
  using F = typename By::Floats;
  using I = typename By::Ints;
  using Lanes<By>::load;
  using Lanes<By>::store;
  using Lanes<By>::picked;
  using Lanes<By>::least;
  using Lanes<By>::most;

  [[gnu::always_inline]] static inline float leastOf(const F& f) {
    float found = f[0];
    for (unsigned lane = 1; lane < By::kLanes; ++lane) found = f[lane] < found ? f[lane] : found;
    return found;
  }

  [[gnu::always_inline]] static inline bool project(const float* x, const float* y, const float* z,
                                                    unsigned count, const PictureMatrix& m, float* px,
                                                    float* py, float* nearness, PictureBounds& bounds) {
    I told = ~I{};
    F left = F{} + kFarthest, low = left, right = -left, high = right, nearest{};
    for (unsigned i = 0; i < count; i += By::kLanes) {
      const F vx = load(x + i), vy = load(y + i), vz = load(z + i);
      const F w = m.w[0] * vx + (m.w[1] * vy + (m.w[2] * vz + m.w[3])), scale = 1.0f / w;
      const F atX = (m.x[0] * vx + (m.x[1] * vy + (m.x[2] * vz + m.x[3]))) * scale;
      const F atY = (m.y[0] * vx + (m.y[1] * vy + (m.y[2] * vz + m.y[3]))) * scale;
      told &=
          (w > kNearest) & (atX > -kFarthest) & (atX < kFarthest) & (atY > -kFarthest) & (atY < kFarthest);
      left = least(left, atX), right = most(right, atX), low = least(low, atY), high = most(high, atY);
      nearest = most(nearest, scale);
      store(px + i, atX), store(py + i, atY), store(nearness + i, scale);
    }
    bounds = {leastOf(left), -leastOf(-right), leastOf(low), -leastOf(-high), -leastOf(-nearest)};
    return By::bits(told) == (1u << By::kLanes) - 1;
  }

  /// Lanes with a value n + 1/2, n whole, between the two.
  [[gnu::always_inline]] static inline I holdsAMiddle(const F& from, const F& to) {
    constexpr float kPositive = 16384;  // so that truncation rounds down
    const F last =
        __builtin_convertvector(__builtin_convertvector(to + (kPositive - 0.5f + kSnapping), I), F);
    return last >= from + (kPositive - 0.5f - kSnapping);
  }

  /// Returns the square of a coordinate, rounded down.
  [[gnu::always_inline]] static inline I squareOf(const F& at, float middle, int count) {
    const I square = __builtin_convertvector(at + middle, I) >> 2;
    const I capped = square < count ? square : I{} + (count - 1);
    return capped > 0 ? capped : I{};
  }

  /// Returns those triangles in `bits` that are not wholly behind drawn surfaces.
  [[gnu::always_inline]] static inline unsigned notHidden(unsigned bits, const SeenSquares& seen,
                                                          const F& left, const F& right, const F& low,
                                                          const F& high, const F& nearest) {
    static_assert(kSquare == 4);
    const I x0 = squareOf(left - 1.0f, seen.middleX, seen.wide),
            x1 = squareOf(right + 1.0f, seen.middleX, seen.wide);
    const I y0 = squareOf(low - 1.0f, seen.middleY, seen.high),
            y1 = squareOf(high + 1.0f, seen.middleY, seen.high);
    for (unsigned left_ = bits; left_ != 0; left_ &= left_ - 1) {
      const unsigned lane = static_cast<unsigned>(__builtin_ctz(left_));
      const float mine = nearest[lane];
      bool hidden = true;
      for (int y = y0[lane]; hidden && y <= y1[lane]; ++y)
        for (int x = x0[lane]; hidden && x <= x1[lane]; ++x) hidden = mine < seen.nearness[y * seen.wide + x];
      if (hidden) bits &= ~(1u << lane);
    }
    return bits;
  }

  [[gnu::always_inline]] static inline unsigned keep(const int* a, const int* b, const int* c, unsigned count,
                                                     const float* px, const float* py, const float* nearness,
                                                     float facing, const SeenSquares& seen, unsigned* out) {
    unsigned written = 0;
    for (unsigned t = 0; t < count; t += By::kLanes) {
      const F ax = picked(px, a + t), bx = picked(px, b + t), cx = picked(px, c + t);
      const F ay = picked(py, a + t), by = picked(py, b + t), cy = picked(py, c + t);
      const F left = least(ax, least(bx, cx)), right = most(ax, most(bx, cx));
      const F low = least(ay, least(by, cy)), high = most(ay, most(by, cy));
      const F area = facing * ((bx - ax) * (cy - ay) - (cx - ax) * (by - ay));
      const F slack = 2 * kSnapping * ((right - left) + (high - low) + kSnapping);
      const I kept = (area > -slack) & holdsAMiddle(left, right) & holdsAMiddle(low, high);
      const unsigned there = count - t < By::kLanes ? (1u << (count - t)) - 1 : ~0u;
      unsigned found = By::bits(kept) & there;
      if (seen.nearness && found != 0) {
        const F nearest =
            most(picked(nearness, a + t), most(picked(nearness, b + t), picked(nearness, c + t)));
        found = notHidden(found, seen, left, right, low, high, nearest);
      }
      for (unsigned bits = found; bits != 0; bits &= bits - 1) {
        const unsigned i = t + static_cast<unsigned>(__builtin_ctz(bits));
        out[written] = static_cast<unsigned>(a[i]);
        out[written + 1] = static_cast<unsigned>(b[i]);
        out[written + 2] = static_cast<unsigned>(c[i]);
        written += 3;
      }
    }
    return written;
  }
};

/// Works row by row of squares: first the farthest depth of each column of pixels, then of each square.
[[gnu::always_inline]] inline void farthestOfSquares(const float* depths, int width, int height,
                                                     const NearnessOfDepth& of, float* nearness) {
  constexpr int kAtOnce = 64;  // columns; a multiple of a square's
  const int wide = (width + kSquare - 1) / kSquare;
  for (int bottom = 0; bottom < height; bottom += kSquare) {
    const int top = bottom + kSquare < height ? bottom + kSquare : height;
    float* out = nearness + (bottom / kSquare) * wide;
    for (int first = 0; first < width; first += kAtOnce) {
      float farthest[kAtOnce];
      for (float& depth : farthest) depth = 1;
      const int columns = width - first < kAtOnce ? width - first : kAtOnce;
      for (int y = bottom; y < top; ++y) {
        const float* row = depths + static_cast<long>(y) * width + first;
        for (int x = 0; x < columns; ++x) farthest[x] = row[x] < farthest[x] ? row[x] : farthest[x];
      }
      for (int x = 0; x < columns; x += kSquare) {
        float depth = 1;
        for (int k = x; k < x + kSquare; ++k) depth = farthest[k] < depth ? farthest[k] : depth;
        out[(first + x) / kSquare] = of.scale * depth + of.offset;
      }
    }
  }
}

}  // namespace
}  // namespace stadion
