#pragma once
/// Places vertices and sets up triangles, as many at a time as By has lanes.
///
/// Linkage  internal.

#include "pipeline/cpu_draw/kernels/kernel_data.h"
#include "pipeline/cpu_draw/kernels/lanes.h"

namespace stadion {
namespace {

template <class By>
struct TriangleSetup : DrawLanes<By> {
  using L = DrawLanes<By>;
  using F = typename L::F;
  using I = typename L::I;
  static constexpr int kLanes = By::kLanes;
  static constexpr float kFarthest = 32768;  ///< beyond, single precision is too coarse for edges [pixels]

  [[gnu::always_inline]] static inline void place(const MeshPositions& from, unsigned count,
                                                  const PixelMatrix& m, bool parallel,
                                                  const PlacedVertices& to) {
    for (unsigned i = 0; i < count; i += kLanes) {
      const F x = L::load(from.x + i), y = L::load(from.y + i), z = L::load(from.z + i);
      const auto row = [&](const float* r) { return r[0] * x + (r[1] * y + (r[2] * z + r[3])); };
      const F last = row(m.w);
      const F per = parallel ? L::all(1) : 1.0f / last;
      const F columns[4] = {row(m.x) * per, row(m.y) * per, parallel ? last : per, F{}};
      By::rows(columns, [&](int lane) { return to.at + 4 * (i + static_cast<unsigned>(lane)); });
    }
  }

  struct Corner {
    F x, y, depth;
  };
  [[gnu::always_inline]] static inline Corner corner(const PlacedVertices& at, const int* which) {
    F columns[4];
    By::columns([&](int lane) { return at.at + 4 * static_cast<long>(which[lane]); }, columns);
    return {columns[0], columns[1], columns[2]};
  }
  [[gnu::always_inline]] static inline void order(Corner& low, Corner& high) {
    const I turned = high.y < low.y;
    const Corner kept = low;
    low = {L::select(turned, high.x, low.x), L::select(turned, high.y, low.y),
           L::select(turned, high.depth, low.depth)};
    high = {L::select(turned, kept.x, high.x), L::select(turned, kept.y, high.y),
            L::select(turned, kept.depth, high.depth)};
  }
  [[gnu::always_inline]] static inline I isSeen(const Corner& c, const SetupParameters& s) {
    return (c.depth > s.leastDepth) & (c.depth <= s.mostDepth);
  }
  [[gnu::always_inline]] static inline I isNear(const Corner& c) {
    return (L::size(c.x) < kFarthest) & (L::size(c.y) < kFarthest);
  }

  [[gnu::always_inline]] static inline unsigned setUp(const TriangleCorners& corners, unsigned first,
                                                      unsigned count, const PlacedVertices& at,
                                                      const SetupParameters& s, TriangleRecord* out) {
    unsigned made = 0;
    for (unsigned t = 0; t < count; t += kLanes) {
      const unsigned here = count - t < kLanes ? count - t : kLanes;
      made += some(corners, first + t, (1U << here) - 1, at, s, out + made);
    }
    return made;
  }

  /// Numbers of the first and the last pixel with a sample in a stretch, and whether there is one. Samples
  /// lie at (i + 1/2) / samples.
  [[gnu::always_inline]] static inline I span(F from, F to, float samples, int size, F& first, F& last) {
    const F low = L::ceiling(from * samples - 0.5f), high = L::floor(to * samples - 0.5f);
    first = L::most(L::floor(low * (1.0f / samples)), F{});
    last = L::least(L::floor(high * (1.0f / samples)), L::all(static_cast<float>(size - 1)));
    return (low <= high) & (first <= last);
  }

  /// Slopes of the edges between sorted corners [x a row].
  struct Edges {
    F longest, lower, upper;
    I longIsLeft;
    [[gnu::always_inline]] inline Edges(const Corner& a, const Corner& b, const Corner& c)
        : longest((c.x - a.x) / (c.y - a.y)), lower((b.x - a.x) / (b.y - a.y)),
          upper((c.x - b.x) / (c.y - b.y)),
          longIsLeft((c.x - a.x) * (b.y - a.y) - (c.y - a.y) * (b.x - a.x) < 0.0f) {}
  };

  /// Whether triangles cover a sample of the two by two pixels at (left, low). Computes what Coverage
  /// computes.
  [[gnu::always_inline]] static inline I covers(const Corner& a, const Corner& b, const Corner& c,
                                                const Edges& edges, F left, F low, int samples) {
    const int(*places)[2] = samples == 1   ? kOneSample
                            : samples == 2 ? kTwoSamples
                            : samples == 4 ? kFourSamples
                                           : kEightSamples;
    const float part = 1 / static_cast<float>(2 * samples);
    I found{};
    for (int i = 0; i < 2 * samples; ++i) {
      const int* place = places[i < samples ? i : i - samples];
      const F at = (i < samples ? low : low + 1.0f) + static_cast<float>(place[1]) * part;
      const F up = at - a.y;
      const F across = a.x + up * edges.longest;
      const F beside = L::select(at < b.y, a.x + up * edges.lower, b.x + (at - b.y) * edges.upper);
      const F from = L::select(edges.longIsLeft, across, beside),
              to = L::select(edges.longIsLeft, beside, across);
      const F x = left + static_cast<float>(place[0]) * part, next = x + 1.0f;
      found |= (at >= a.y) & (at < c.y) & (((x >= from) & (x < to)) | ((next >= from) & (next < to)));
    }
    return found;
  }

  /// Several lanes of one record's field.
  struct Fields {
    alignas(64) float at[12][kLanes];
    alignas(64) int box[4][kLanes];
    alignas(64) int flags[kLanes];
  };

  [[gnu::always_inline]] static inline unsigned some(const TriangleCorners& corners, unsigned t,
                                                     unsigned lanes, const PlacedVertices& at,
                                                     const SetupParameters& s, TriangleRecord* out) {
    Corner a = corner(at, corners.a + t), b = corner(at, corners.b + t), c = corner(at, corners.c + t);
    const I aSeen = isSeen(a, s), bSeen = isSeen(b, s), cSeen = isSeen(c, s);
    const I regular = aSeen & bSeen & cSeen & isNear(a) & isNear(b) & isNear(c);
    const I unfinished = (aSeen | bSeen | cSeen) & ~regular;
    const F area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
    const I visible = s.facing > 0 ? I(area > 0.0f) : s.facing < 0 ? I(area < 0.0f) : I(area != 0.0f);
    F left, right, low, high;
    const float samples = static_cast<float>(s.samples);
    const I across = span(L::least(a.x, L::least(b.x, c.x)), L::most(a.x, L::most(b.x, c.x)), samples,
                          s.width, left, right);
    const I along = span(L::least(a.y, L::least(b.y, c.y)), L::most(a.y, L::most(b.y, c.y)), samples,
                         s.height, low, high);
    const I whole = regular & visible & across & along;
    unsigned wanted = L::bits(whole | unfinished) & lanes;
    if (wanted == 0) return 0;

    const I away = s.mirrored > 0 ? I(area < 0.0f) : I(area > 0.0f);
    order(a, b);
    order(b, c);
    order(a, b);
    const Edges edges(a, b, c);
    const I small = whole & (right - left < 2.0f) & (high - low < 2.0f);
    if (L::bits(small) & lanes) wanted &= ~L::bits(small & ~covers(a, b, c, edges, left, low, s.samples));
    if (wanted == 0) return 0;
    Fields f;
    fill(a, b, c, edges, left, low, s, f);
    const auto number = [&](int k, F x) { L::storeInts(f.box[k], L::truncated(L::where(whole, x))); };
    number(0, left);
    number(1, low);
    number(2, right);
    number(3, high);
    L::storeInts(f.flags, (edges.longIsLeft & static_cast<int>(kLongEdgeIsLeft)) |
                              (away & static_cast<int>(kFacesAway)) |
                              (unfinished & static_cast<int>(kUnfinished)));
    unsigned made = 0;
    for (; wanted != 0; wanted &= wanted - 1) {
      const auto lane = static_cast<unsigned>(__builtin_ctz(wanted));
      TriangleRecord& r = out[made++];
      float* to = &r.x0;
      for (int k = 0; k < 12; ++k) to[k] = f.at[k][lane];
      r.left = static_cast<short>(f.box[0][lane]);
      r.low = static_cast<short>(f.box[1][lane]);
      r.right = static_cast<short>(f.box[2][lane]);
      r.high = static_cast<short>(f.box[3][lane]);
      r.triangle = t + lane;
      r.sourceAndFlags = s.source << kFlagBits | static_cast<unsigned>(f.flags[lane]);
    }
    return made;
  }

  /// Computes the fields of a triangle from its sorted corners.
  [[gnu::always_inline]] static inline void fill(const Corner& a, const Corner& b, const Corner& c,
                                                 const Edges& edges, F left, F low, const SetupParameters& s,
                                                 Fields& f) {
    const F bx = b.x - a.x, by = b.y - a.y, cx = c.x - a.x, cy = c.y - a.y;
    const F bd = b.depth - a.depth, cd = c.depth - a.depth;
    const F per = 1.0f / (bx * cy - by * cx);
    const F right = (bd * cy - cd * by) * per, up = (cd * bx - bd * cx) * per;
    const F most = L::most(a.depth, L::most(b.depth, c.depth));
    const F steep = L::most(L::size(right), L::size(up));
    const F step = F(I(L::size(most)) & 0x7f800000) * 1.1920929e-7f;
    const F offset =
        s.slopeOffset == 0 && s.stepOffset == 0 ? F{} : s.slopeOffset * steep + s.stepOffset * step;
    const F at = a.depth - right * (a.x - left) - up * (a.y - low) + offset;
    const F values[12] = {a.x,         a.y,         b.x,   b.y, c.y, edges.longest,
                          edges.lower, edges.upper, right, up,  at,  most + offset};
    for (int k = 0; k < 12; ++k) L::store(f.at[k], values[k]);
  }
};

}  // namespace
}  // namespace stadion
