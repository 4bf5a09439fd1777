#pragma once
/// The functions of raster_kernels.h, for as many triangles at a time as By has lanes. Internal to
/// pipeline/raster/.
///
/// Linkage  internal.

#include "pipeline/raster/raster_kernels.h"
#include "pipeline/raster/raster_lanes.h"

namespace stadion {
namespace {

template <class By>
struct Raster : Lanes<By> {
  using F = typename By::Floats;
  using I = typename By::Ints;
  using Lanes<By>::load;
  using Lanes<By>::store;
  using Lanes<By>::least;
  using Lanes<By>::most;
  static constexpr unsigned kLanes = By::kLanes;
  static constexpr int kGrid = 256;  ///< steps a pixel

  [[gnu::always_inline]] static inline void shade(const VerticesToShade& v, unsigned first, unsigned end,
                                                  const Shading& by, const PictureVertices& out) {
    const float* m = by.normals;
    for (unsigned i = first / kLanes * kLanes; i < end; i += kLanes) {
      const F x = load(v.nx + i), y = load(v.ny + i), z = load(v.nz + i);
      F nx = m[0] * x + m[1] * y + m[2] * z, ny = m[3] * x + m[4] * y + m[5] * z,
        nz = m[6] * x + m[7] * y + m[8] * z;
      const F scale = 1.0f / By::root(most(nx * nx + ny * ny + nz * nz, F{} + 1e-30f));
      nx *= scale, ny *= scale, nz *= scale;
      F r = F{} + by.ambient[0], g = F{} + by.ambient[1], b = F{} + by.ambient[2];
      for (unsigned l = 0; l < by.lightCount; ++l) {
        const ShadingLight& light = by.lights[l];
        const F lit = most(nx * light.direction[0] + ny * light.direction[1] + nz * light.direction[2], F{});
        r += light.colour[0] * lit, g += light.colour[1] * lit, b += light.colour[2] * lit;
      }
      store(out.r + i, least(by.emissive[0] + by.base[0] * load(v.r + i) * r, F{} + 1.0f));
      store(out.g + i, least(by.emissive[1] + by.base[1] * load(v.g + i) * g, F{} + 1.0f));
      store(out.b + i, least(by.emissive[2] + by.base[2] * load(v.b + i) * b, F{} + 1.0f));
    }
  }

  /// Moves a coordinate onto the grid, measured from the picture's lower left.
  [[gnu::always_inline]] static inline I onGrid(const F& at, int middle) {
    const F steps = at * static_cast<float>(kGrid);
    return __builtin_convertvector(steps + (steps < 0.0f ? F{} - 0.5f : F{} + 0.5f), I) + middle * kGrid;
  }

  /// The first pixel with its middle at or behind `from`, and the last with its middle at or before `to`.
  [[gnu::always_inline]] static inline I firstMiddle(const I& from) { return (from + (kGrid / 2 - 1)) >> 8; }
  [[gnu::always_inline]] static inline I lastMiddle(const I& to) { return (to - kGrid / 2) >> 8; }

  /// Twice the area of (a, b, p), counter-clockwise; it changes from pixel to pixel by `right` and `up`.
  struct Edge {
    I at, right, up;
  };
  [[gnu::always_inline]] static inline Edge edge(const I& ax, const I& ay, const I& bx, const I& by_,
                                                 const I& px, const I& py) {
    const I dx = bx - ax, dy = by_ - ay;
    return {dx * (py - ay) - dy * (px - ax), -dy * kGrid, dx * kGrid};
  }
  /// A point on the edge is inside if the edge is a left or a lower one: going down, or to the right. OpenGL
  /// leaves this open; Mesa takes these.
  [[gnu::always_inline]] static inline I onEdge(const I& ax, const I& ay, const I& bx, const I& by_) {
    const I inside = (by_ < ay) | ((by_ == ay) & (bx > ax));
    return ~inside;  // -1: a point on the edge is outside
  }

  template <class V>
  [[gnu::always_inline]] static inline void swap(const I& which, V& a, V& b) {
    const V kept = a;
    a = which ? b : a;
    b = which ? kept : b;
  }

  [[gnu::always_inline]] static inline int greatest(const I& of) {
    int most = of[0];
    for (unsigned lane = 1; lane < kLanes; ++lane) most = of[lane] > most ? of[lane] : most;
    return most;
  }

  [[gnu::always_inline]] static inline I byte(const F& x) {
    return __builtin_convertvector(least(most(x, F{}), F{} + 1.0f) * 255.0f + 0.5f, I);
  }

  [[gnu::always_inline]] static inline F picked(const float* from, const I& which) {
    F f;
    for (unsigned lane = 0; lane < kLanes; ++lane) f[lane] = from[which[lane]];
    return f;
  }

  [[gnu::always_inline]] static inline void draw(const unsigned* corners, unsigned triangles,
                                                 const PictureVertices& v, float facing,
                                                 const RasterTarget& to) {
    for (unsigned t = 0; t < triangles; t += kLanes) {
      I a, b, c;
      const unsigned count = triangles - t < kLanes ? triangles - t : kLanes;
      for (unsigned lane = 0; lane < kLanes; ++lane) {
        const unsigned* three = corners + 3 * (t + (lane < count ? lane : 0));
        a[lane] = static_cast<int>(three[0]), b[lane] = static_cast<int>(three[1]);
        c[lane] = static_cast<int>(three[2]);
      }
      drawSome(a, b, c, (1u << count) - 1, v, facing, to);
    }
  }

  [[gnu::always_inline]] static inline void drawSome(I a, I b, I c, unsigned there, const PictureVertices& v,
                                                     float facing, const RasterTarget& to) {
    const int middleX = to.width / 2, middleY = to.height / 2;
    F fax = picked(v.x, a), fay = picked(v.y, a), fbx = picked(v.x, b), fby = picked(v.y, b),
      fcx = picked(v.x, c), fcy = picked(v.y, c);
    I ax = onGrid(fax, middleX), ay = onGrid(fay, middleY), bx = onGrid(fbx, middleX),
      by = onGrid(fby, middleY), cx = onGrid(fcx, middleX), cy = onGrid(fcy, middleY);
    I area = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax);
    const I turned = area < 0;
    swap(turned, b, c), swap(turned, bx, cx), swap(turned, by, cy), swap(turned, fbx, fcx),
        swap(turned, fby, fcy);
    area = turned ? -area : area;

    // Over the surface, values change from corner a on as between the true corners, not those on the grid.
    fbx -= fax, fby -= fay, fcx -= fax, fcy -= fay;
    const F perArea = 1.0f / (fbx * fcy - fcx * fby);
    const I seen = facing > 0 ? ~turned : facing < 0 ? turned : ~I{};
    const I left = most(firstMiddle(least(ax, least(bx, cx))), I{});
    const I low = most(firstMiddle(least(ay, least(by, cy))), I{});
    const I right = least(lastMiddle(most(ax, most(bx, cx))), I{} + (to.width - 1));
    const I high = least(lastMiddle(most(ay, most(by, cy))), I{} + (to.height - 1));
    const I any = seen & (area > 0) & (left <= right) & (low <= high);
    if ((By::bits(any) & there) == 0) return;
    const I wide = any ? right - left : I{} - 1, tall = any ? high - low : I{} - 1;
    const int mostWide = greatest(wide), mostTall = greatest(tall);

    const I px = left * kGrid + kGrid / 2, py = low * kGrid + kGrid / 2;
    const Edge ab = edge(ax, ay, bx, by, px, py), bc = edge(bx, by, cx, cy, px, py),
               ca = edge(cx, cy, ax, ay, px, py);
    const I onAb = onEdge(ax, ay, bx, by), onBc = onEdge(bx, by, cx, cy), onCa = onEdge(cx, cy, ax, ay);

    const F bByX = fcy * perArea, bByY = -fcx * perArea, cByX = -fby * perArea, cByY = fbx * perArea;
    const F fromX = __builtin_convertvector(left - middleX, F) + 0.5f - fax,
            fromY = __builtin_convertvector(low - middleY, F) + 0.5f - fay;
    const F an = picked(v.nearness, a), bn = picked(v.nearness, b), cn = picked(v.nearness, c);
    const F ar = picked(v.r, a), ag = picked(v.g, a), ab_ = picked(v.b, a);
    const F br = picked(v.r, b) - ar, bg = picked(v.g, b) - ag, bb = picked(v.b, b) - ab_;
    const F cr = picked(v.r, c) - ar, cg = picked(v.g, c) - ag, cb = picked(v.b, c) - ab_;

    I rowAb = ab.at, rowBc = bc.at, rowCa = ca.at;
    for (int y = 0; y <= mostTall; ++y) {
      I eAb = rowAb, eBc = rowBc, eCa = rowCa;
      const I inRow = y <= tall;
      for (int x = 0; x <= mostWide; ++x) {
        const I inside = (((eAb + onAb) | (eBc + onBc) | (eCa + onCa)) >= 0) & (x <= wide) & inRow;
        unsigned hit = By::bits(inside) & there;
        if (hit != 0) {
          const F dx = fromX + static_cast<float>(x), dy = fromY + static_cast<float>(y);
          const F inB = dx * bByX + dy * bByY, inC = dx * cByX + dy * cByY;
          const F ofB = inB * bn, ofC = inC * cn, nearness = (1.0f - inB - inC) * an + ofB + ofC,
                  per = 1.0f / nearness;
          const F b1 = ofB * per, c1 = ofC * per;
          const I colour = byte(ar + b1 * br + c1 * cr) | byte(ag + b1 * bg + c1 * cg) << 8 |
                           byte(ab_ + b1 * bb + c1 * cb) << 16 | static_cast<int>(0xff000000u);
          const F depth = to.depthScale * nearness + to.depthOffset;
          const I pixel = (low + y) * to.width + left + x;
          for (; hit != 0; hit &= hit - 1) {
            const unsigned lane = static_cast<unsigned>(__builtin_ctz(hit));
            const int at = pixel[lane];
            const unsigned mine = static_cast<unsigned>(colour[lane]);
            const float theirs = to.depths[at];
            if (depth[lane] > theirs || (depth[lane] == theirs && mine > to.colours[at]))
              to.depths[at] = depth[lane], to.colours[at] = mine;
          }
        }
        eAb += ab.right, eBc += bc.right, eCa += ca.right;
      }
      rowAb += ab.up, rowBc += bc.up, rowCa += ca.up;
    }
  }
};

}  // namespace
}  // namespace stadion
