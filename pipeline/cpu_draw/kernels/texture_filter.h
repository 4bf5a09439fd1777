#pragma once
/// Texels at many places at a time.
///
/// Linkage  internal.

#include "pipeline/cpu_draw/kernels/kernel_data.h"
#include "pipeline/cpu_draw/kernels/lanes.h"

namespace stadion {
namespace {

template <class By>
struct TextureFilter : DrawLanes<By> {
  using L = DrawLanes<By>;
  using F = typename L::F;
  using I = typename L::I;
  using H = typename L::H;
  using T = Triple<F>;

  struct Texel {
    T colour;
    F alpha;
  };

  struct Coordinates {
    F u, v;
  };
  /// Where a texture is read, and its level of detail: 0 = all of it.
  struct Place {
    Coordinates at;
    F level;
  };
  /// The change of texture coordinates for a pixel to the right and a pixel up [of the texture's sides].
  struct Slopes {
    F uRight, vRight, uUp, vUp;
  };

  /// Makes linear light of texels: colours may be stored as square roots, alpha is not.
  struct Linear {
    int rootsOfRedBlue, factorOfRedBlue, rootsOfGreen, factorOfGreenAlpha;
    [[gnu::always_inline]] inline explicit Linear(bool roots)
        : rootsOfRedBlue(roots ? 0x00ff00ff : 0), factorOfRedBlue(roots ? 0 : 0x00ff00ff),
          rootsOfGreen(roots ? 0xff : 0), factorOfGreenAlpha(roots ? 0x00ff0000 : 0x00ff00ff) {}
    /// In sixteen bits each, where 255 * 255 is one.
    [[gnu::always_inline]] inline H redBlue(I texel) const {
      const I stored = texel & 0x00ff00ff;
      return H(stored) * H((stored & rootsOfRedBlue) | factorOfRedBlue);
    }
    [[gnu::always_inline]] inline H greenAlpha(I texel) const {
      const H stored = H(texel) >> 8;
      return stored * H((I(stored) & rootsOfGreen) | factorOfGreenAlpha);
    }
  };

  /// Four means of texels in sixteen bits each: red and blue, green and alpha.
  struct Sum {
    static constexpr float kPerOne = 1.0f / 64770;  ///< of a sum with all weight, 256
    H redBlue{}, greenAlpha{};
    /// Each product loses half a unit on average. Four of them are added after this, in the lanes of `added`.
    [[gnu::always_inline]] inline void roundFour(I added) {
      const H lost = H(added & 0x00020002);
      redBlue += lost;
      greenAlpha += lost;
    }
    [[gnu::always_inline]] inline void add(const Linear& linear, I texel, I weight) {
      weight = (weight << 8) - weight;
      const H both = H(weight | weight << 16);
      redBlue += By::highProduct(linear.redBlue(texel), both);
      greenAlpha += By::highProduct(linear.greenAlpha(texel), both);
    }
  };

  /// Keeps a coordinate in 0 .. 1; one that is not finite becomes 1.
  [[gnu::always_inline]] static inline F wrapped(F at, TextureWrap wrap) {
    if (wrap == TextureWrap::Repeat) at = at - L::floor(at);
    if (wrap == TextureWrap::Mirror) {
      const F half = 0.5f * at;
      at = L::size(2.0f * (half - L::floor(half + 0.5f)));
    }
    return L::most(L::least(at, L::all(1)), F{});
  }
  /// Wraps the indices of a texel and its neighbour, one of which may lie beyond the edge.
  [[gnu::always_inline]] static inline void neighbours(I& first, I& second, I count, TextureWrap wrap) {
    if (wrap == TextureWrap::Repeat) {
      first += I(first < 0) & count;
      first &= ~I(first >= count);
      second &= ~I(second >= count);
    } else {
      second = second < count ? second : count - 1;
      first &= ~I(first < 0);
    }
  }

  /// Levels of a texture, one in each lane.
  struct Levels {
    I width, height, first;
    [[gnu::always_inline]] inline Levels(const TextureParameters& t, I number)
        : width(By::entry(t.width, number)), height(By::entry(t.height, number)),
          first(By::entry(t.first, number)) {}
  };

  /// Adds the mean of the four texels around a place in linear light, times `weight` of 256. `squares`: where it
  /// is the nearest texel instead; null: nowhere.
  template <bool kUnusual>
  [[gnu::always_inline]] static inline void add(const TextureParameters& t, const Linear& linear,
                                                const Levels& level, F u, F v, F weight, const I* squares,
                                                Sum& sum) {
    const F width = L::whole(level.width);
    F x = u * width - 0.5f, y = v * L::whole(level.height) - 0.5f;
    if constexpr (kUnusual) {
      if (squares)
        x = L::select(*squares, L::floor(x + 0.5f), x), y = L::select(*squares, L::floor(y + 0.5f), y);
      if (t.wrapU != TextureWrap::Repeat) x = L::most(L::least(x, width - 1.0f), F{});
      if (t.wrapV != TextureWrap::Repeat) y = L::most(L::least(y, L::whole(level.height) - 1.0f), F{});
    }
    const F left = L::floor(x), top = L::floor(y);
    I x0 = L::truncated(left), y0 = L::truncated(top), y1 = y0 + 1;
    x0 += I(x0 < 0) & level.width;  // the texel at the end of a row is the first one
    neighbours(y0, y1, level.height, kUnusual ? t.wrapV : TextureWrap::Repeat);
    const I all = L::truncated(weight), right = L::truncated(weight * (x - left)), rest = all - right;
    const I lowRight = L::truncated(L::whole(right) * (y - top)),
            lowLeft = L::truncated(L::whole(rest) * (y - top));
    const int* from = reinterpret_cast<const int*>(t.texels);
    sum.roundFour(I(all > 0));
    const I row = level.width + 1, column = level.first + x0;
    I here, next;
    By::pairs(from, y0 * row + column, here, next);
    sum.add(linear, here, rest - lowLeft);
    sum.add(linear, next, right - lowRight);
    By::pairs(from, y1 * row + column, here, next);
    sum.add(linear, here, lowLeft);
    sum.add(linear, next, lowRight);
  }

  [[gnu::always_inline]] static inline F levelOf(const TextureParameters& t, const Slopes& p) {
    const float w = static_cast<float>(t.width[0]), h = static_cast<float>(t.height[0]);
    const F right = p.uRight * p.uRight * (w * w) + p.vRight * p.vRight * (h * h);
    const F up = p.uUp * p.uUp * (w * w) + p.vUp * p.vUp * (h * h);
    const F level = 0.5f * L::log2(L::most(L::most(right, up), L::all(1)));
    return L::least(level, L::all(static_cast<float>(t.levels - 1)));
  }

  /// `roots`: colours are stored as square roots.
  [[gnu::always_inline]] static inline Texel at(const TextureParameters& t, const Place& p, bool nearestLevel,
                                                bool roots) {
    if (t.unusual) return unusual(t, p, nearestLevel, roots);
    const F u = wrapped(p.at.u, TextureWrap::Repeat), v = wrapped(p.at.v, TextureWrap::Repeat);
    const F level = nearestLevel ? L::floor(p.level + 0.5f) : p.level;
    return blended<false>(t, {{u, v}, level}, roots, nullptr);
  }

private:
  [[gnu::noinline]] static Texel unusual(const TextureParameters& t, const Place& p, bool nearestLevel,
                                         bool roots) {
    F level = p.level;
    const I none{}, squares = By::select(level > 0.0f, none - t.minifiesNearest, none - t.magnifiesNearest);
    if (nearestLevel || t.mipmaps == 1) level = L::floor(level + 0.5f);
    if (t.mipmaps == 2) level = F{};
    const Place at{{wrapped(p.at.u, t.wrapU), wrapped(p.at.v, t.wrapV)}, level};
    return blended<true>(t, at, roots, &squares);
  }

  /// Of two levels. Expects coordinates from 0 to 1.
  template <bool kUnusual>
  [[gnu::always_inline]] static inline Texel blended(const TextureParameters& t, const Place& p, bool roots,
                                                     const I* squares) {
    const F level = p.level;
    const I whole = L::truncated(level), last = I{} + (t.levels - 1);
    const F coarser = L::floor(256.0f * (level - L::whole(whole)));
    const Linear linear(roots);
    Sum out;
    add<kUnusual>(t, linear, Levels(t, whole), p.at.u, p.at.v, 256.0f - coarser, squares, out);
    if (L::bits(coarser > 0.0f) != 0)
      add<kUnusual>(t, linear, Levels(t, whole < last ? whole + 1 : last), p.at.u, p.at.v, coarser, squares,
                    out);
    const auto low = [](H two) { return L::whole(I(two) & 0xffff) * Sum::kPerOne; };
    const auto high = [](H two) { return L::whole((I(two) >> 16) & 0xffff) * Sum::kPerOne; };
    return {{low(out.redBlue), low(out.greenAlpha), high(out.redBlue)}, high(out.greenAlpha)};
  }
};

}  // namespace
}  // namespace stadion
