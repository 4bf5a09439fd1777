#pragma once
/// Light, air and shadows, as the shaders compute them (pipeline/shader/shaders.h explains the model).
///
/// Linkage  internal.

#include "pipeline/cpu_draw/kernels/kernel_data.h"
#include "pipeline/cpu_draw/kernels/tone_curves.h"

namespace stadion {
namespace {

template <class By>
struct LightModel : DrawLanes<By> {
  using L = DrawLanes<By>;
  using F = typename L::F;
  using I = typename L::I;
  using T = Triple<F>;
  static constexpr int kLanes = By::kLanes;
  static constexpr int kTileShift = 1;
  static_assert(1 << kTileShift == kShadowTile);
  static constexpr float kPerE = -1.442695f;  ///< exp(-x) = 2^(kPerE x)

  /// The sun's glow in the air.
  [[gnu::always_inline]] static inline T glow(const T& d, const SceneParameters& s) {
    const F off = L::most(1.0f - T::dot(d, T::of(s.sunDirection)), F{});
    const F narrow = 1.0f + 900.0f * off, wide = 1.0f + 18.0f * off, per = 1.0f / (narrow * wide);
    const F near = wide * per;
    return T::of(s.sunColour) * ((0.3f * near * near + 0.06f * (narrow * per)) * s.sunShare);
  }
  /// Air without end, seen in direction d.
  [[gnu::always_inline]] static inline T airWithoutGlow(const T& d, const SceneParameters& s) {
    const F low = 1.0f - L::most(d.z, F{}), squared = low * low;
    return T::mix(T::of(s.zenith), T::of(s.horizon), squared * squared);
  }
  [[gnu::always_inline]] static inline T air(const T& d, const SceneParameters& s) {
    return airWithoutGlow(d, s) + glow(d, s);
  }
  [[gnu::always_inline]] static inline F softClip(F c) { return ToneCurves<By>::softClip(c); }
  [[gnu::always_inline]] static inline T softClip(const T& c) {
    return {softClip(c.x), softClip(c.y), softClip(c.z)};
  }
  /// The colour that light is shown with.
  [[gnu::always_inline]] static inline T shown(const T& light, const SceneParameters& s) {
    return s.toned ? ToneCurves<By>::shown(light, s.exposure, s.curve) : softClip(light);
  }
  [[gnu::always_inline]] static inline T ambientFrom(F up, const SceneParameters& s) {
    const T low = T::of(s.ground) + T::of(0.3f);
    return T::of(s.ambient) * T::mix(low, T::of(1.0f), 0.5f + 0.5f * up);
  }

  /// The light of a lamp at a place: how much arrives there, and from where.
  [[gnu::always_inline]] static inline F strengthAt(const LightParameters& light, const T& placed,
                                                    T& towards) {
    towards = T::of(light.towards);
    if (light.kind == 0) return L::all(1);
    T to = T::of(light.position) - placed;
    const F squared = L::most(T::dot(to, to), L::all(1e-12f));
    to = to * L::perRoot(squared);
    const F fading = L::most(1.0f - squared * light.perRangeSquared, F{});
    F strength = fading * fading;
    if (light.fallsOff) strength = strength / L::most(squared, L::all(0.01f));
    if (light.kind == 2) {
      const F inside = L::clamp((T::dot(to, towards) - light.coneOuter) * light.perCone);
      strength *= inside * inside * (3.0f - 2.0f * inside);
    }
    towards = to;
    return strength;
  }

  /// How far a place lies from the middle of a ring's quarter of the map; the quarter ends at 0.25.
  [[gnu::always_inline]] static inline F outside(F x, F y, const float* ring, float middleX, float middleY) {
    return L::most(L::size(x * ring[3] + ring[0] - middleX), L::size(y * ring[3] + ring[1] - middleY));
  }

  /// A place in the map: texels, depth, and how far it lies from the middle of the widest ring.
  struct ShadowPlace {
    F u, v, depth, edge;
  };
  [[gnu::always_inline]] static inline ShadowPlace shadowPlace(const ShadowParameters& s, const T& placed,
                                                               const T& n) {
    const T right = T::of(s.right), up = T::of(s.up), towards = T::of(s.towards);
    F x = T::dot(right, placed), y = T::dot(up, placed), z = T::dot(towards, placed);
    F ringX = L::all(s.rings[3][0]), ringY = L::all(s.rings[3][1]), ringZ = L::all(s.rings[3][2]),
      scale = L::all(s.rings[3][3]), lift = L::all(s.lift[3]);
    const F edge = outside(x, y, s.rings[3], 0.75f, 0.75f);
    constexpr float kMiddle[3][2] = {{0.25f, 0.25f}, {0.75f, 0.25f}, {0.25f, 0.75f}};
    for (int i = 2; i >= 0; --i) {
      const float* r = s.rings[i];
      const I in = outside(x, y, r, kMiddle[i][0], kMiddle[i][1]) < 0.245f;
      ringX = L::select(in, L::all(r[0]), ringX);
      ringY = L::select(in, L::all(r[1]), ringY);
      ringZ = L::select(in, L::all(r[2]), ringZ);
      scale = L::select(in, L::all(r[3]), scale);
      lift = L::select(in, L::all(s.lift[i]), lift);
    }
    x += lift * T::dot(right, n);
    y += lift * T::dot(up, n);
    z += lift * T::dot(towards, n);
    constexpr float kSide = kShadowSide;
    const auto texel = [](F at) { return L::most(L::least(at * kSide - 0.5f, L::all(kSide)), L::all(-1)); };
    return {texel(x * scale + ringX), texel(y * scale + ringY), L::clamp(z * s.depthScale + ringZ), edge};
  }

  /// The part of the light that arrives.
  [[gnu::always_inline]] static inline F lightArriving(const ShadowParameters& s, const ShadowPlace& p) {
    return beyondRings(s.taps == 16 ? sixteen(s, p.u, p.v, p.depth) : four(s, p.u, p.v, p.depth), p.edge);
  }
  /// Shadows end where the widest ring does.
  [[gnu::always_inline]] static inline F beyondRings(F lit, F edge) {
    return lit + (1.0f - lit) * L::clamp((edge - 0.22f) * 40.0f);
  }

  /// The tile of a place, and whether all of it lets light through, or none of it.
  struct ShadowTile {
    I x, y, light, dark;
  };
  [[gnu::always_inline]] static inline ShadowTile shadowTile(const ShadowParameters& s,
                                                             const ShadowPlace& p) {
    return tileAt(s, corner(L::floor(p.u - 0.75f)), corner(L::floor(p.v - 0.75f)), p.depth);
  }
  [[gnu::always_inline]] static inline ShadowTile tileAt(const ShadowParameters& s, I x, I y, F depth) {
    ShadowTile tile{x >> kTileShift, y >> kTileShift, {}, {}};
    I least, most;
    By::pairs(reinterpret_cast<const int*>(s.bounds), (tile.y * (kShadowSide / kShadowTile) + tile.x) * 2,
              least, most);
    tile.light = depth >= F(most);
    tile.dark = depth < F(least);
    return tile;
  }
  /// The first of four texels in a row.
  [[gnu::always_inline]] static inline I corner(F x) {
    return L::truncated(L::most(L::least(x, L::all(kShadowSide - 4)), F{}));
  }

  /// The four weights of two bilinear lookups at `at` -+ 0.75 texels, and the first of the four texels.
  [[gnu::always_inline]] static inline F weights(F at, F* w) {
    const F low = at - 0.75f, high = at + 0.75f, first = L::floor(low), second = L::floor(high);
    const F f = low - first, g = high - second;
    const I apart = second - first > 1.5f;
    w[0] = 1.0f - f;
    w[1] = L::select(apart, f, f + 1.0f - g);
    w[2] = L::select(apart, 1.0f - g, g);
    w[3] = L::where(apart, g);
    return first;
  }

  /// The mean of four lookups of two by two texels each.
  [[gnu::always_inline]] static inline F sixteen(const ShadowParameters& s, F u, F v, F depth) {
    F across[4], along[4];
    const F left = weights(u, across), low = weights(v, along);
    const I x = corner(left), y = corner(low);
    // Most places are in light, or in shadow, as a whole.
    const ShadowTile tile = tileAt(s, x, y, depth);
    F lit{};
    if (L::bits(tile.light | tile.dark) != L::kAll) {
      alignas(64) int at[kLanes];
      L::storeInts(at, y * kShadowSide + x);
      for (int j = 0; j < 4; ++j) {
        F texel[4], row{};
        By::columns([&](int lane) { return s.depths + at[lane] + j * kShadowSide; }, texel);
        for (int i = 0; i < 4; ++i) row += L::where(depth >= texel[i], across[i]);
        lit += row * along[j];
      }
      lit *= 0.25f;
    }
    return L::select(tile.light, L::all(1), L::where(~tile.dark, lit));
  }

  /// Looks up two by two texels and returns their weighted mean.
  [[gnu::always_inline]] static inline F four(const ShadowParameters& s, F u, F v, F depth) {
    const F left = L::floor(u), low = L::floor(v), f = u - left, g = v - low;
    const auto corner = [](F x) { return L::truncated(L::most(L::least(x, L::all(kShadowSide - 2)), F{})); };
    const I at = corner(low) * kShadowSide + corner(left);
    const auto row = [&](int first) {
      I here, next;
      By::pairs(reinterpret_cast<const int*>(s.depths) + first, at, here, next);
      return L::where(depth >= F(here), 1.0f - f) + L::where(depth >= F(next), f);
    };
    const F below = row(0), above = row(kShadowSide);
    return below + (above - below) * g;
  }
};

}  // namespace
}  // namespace stadion
