#pragma once
/// Light from all around, as the OpenGL programs compute it (pipeline/shader/environment_text.h explains it).
///
/// Linkage  internal.

#include "pipeline/cpu_draw/kernels/kernel_data.h"
#include "pipeline/cpu_draw/kernels/lanes.h"

namespace stadion {
namespace {

template <class By>
struct SurroundingLight : DrawLanes<By> {
  using L = DrawLanes<By>;
  using F = typename L::F;
  using I = typename L::I;
  using T = Triple<F>;
  using Environment = EnvironmentParameters;

  struct Finish {
    F roughness, metallic;
    F nv;  ///< cosine of the angle between normal and eye, above 0
  };

  /// Light of a surface: by * base colour + with. `base`: its base colour; null: it is no metal.
  [[gnu::noinline]] static void respond(const Environment& e, const Finish& m, const T& n, const T& reflected,
                                        const T* base, T& by, T& with) {
    const T normal = turned(n, e), matt = mattFrom(normal, e);
    const T mirrored = mirroredFrom(turned(reflected, e), normal, m.roughness, e);
    const WhiteShare white = whiteShareOf(m);
    const F scale = white.scale, bias = white.bias, lost = 1.0f - (scale + bias);
    const Share plain = shareOf(L::all(0.04f), scale, bias, lost);
    by = matt * ((1.0f - (plain.once + plain.often)) * (1.0f - m.metallic));
    if (!base) {
      with = mirrored * plain.once + matt * plain.often;
      return;
    }
    const auto of = [&](F colour, F mirror, F soft) {
      const Share metal = shareOf(colour, scale, bias, lost);
      return mirror * (plain.once + (metal.once - plain.once) * m.metallic) +
             soft * (plain.often + (metal.often - plain.often) * m.metallic);
    };
    with = {of(base->x, mirrored.x, matt.x), of(base->y, mirrored.y, matt.y),
            of(base->z, mirrored.z, matt.z)};
  }

  /// What is seen in direction d, unit.
  [[gnu::always_inline]] static inline T picture(const T& d, const Environment& e) {
    return lookUp(e.picture, turned(d, e), I{}, L::all(static_cast<float>(e.pictureSide))) *
           L::all(e.intensity);
  }

private:
  /// Of the light that arrives, a surface mirrors its colour * scale + bias at once.
  struct WhiteShare {
    F scale, bias;
  };
  [[gnu::always_inline]] static inline WhiteShare whiteShareOf(const Finish& m) {
    const F x = m.nv, y = m.roughness * m.roughness, xy = x * y, xx = x * x, yy = y * y, xxy = xx * y,
            xyy = x * yy, xxyy = xx * yy;
    const auto quadratic = [&](const float(&c)[9]) {
      return c[0] + c[1] * x + c[2] * y + c[3] * xy + c[4] * xx + c[5] * yy + c[6] * xxy + c[7] * xyy +
             c[8] * xxyy;
    };
    const auto within = [](F part) { return L::least(L::most(part, F{}), L::all(1)); };
    const F scale =
        quadratic({0.1003f, -0.6303f, 9.748f, -2.038f, 29.34f, -8.245f, -26.44f, 19.99f, -5.448f}) /
        quadratic({1, -1.765f, 8.263f, 11.53f, 28.96f, -7.507f, -36.11f, 15.86f, 33.37f});
    const F bias =
        quadratic({0.9345f, -2.323f, 2.229f, -3.748f, 1.424f, -0.7684f, 1.436f, 0.2913f, 0.6286f}) /
        quadratic({1, 0.2281f, 15.94f, -55.83f, 13.08f, 41.26f, 54.9f, 300.2f, -285.1f});
    return {within(scale), within(bias)};
  }

  /// Of the light that arrives, what is mirrored at once, and after several reflections.
  struct Share {
    F once, often;
  };
  [[gnu::always_inline]] static inline Share shareOf(F mirror, F scale, F bias, F lost) {
    const F once = mirror * scale + bias, mean = mirror + (1.0f - mirror) * (1.0f / 21);
    return {once, once * mean / (1.0f - lost * mean) * lost};
  }

  [[gnu::always_inline]] static inline T turned(const T& d, const Environment& e) {
    return {d.x * e.turnCos + d.y * e.turnSin, d.y * e.turnCos - d.x * e.turnSin, d.z};
  }

  /// The harmonics in direction d. `first`, `second`: factors of the bands.
  [[gnu::always_inline]] static inline T harmonicsAt(const T& d, F first, F second, const Environment& e) {
    const F xy = second * d.x * d.y, yz = second * d.y * d.z, zz = second * (3.0f * d.z * d.z - 1.0f),
            xz = second * d.x * d.z, xx = second * (d.x * d.x - d.y * d.y);
    const F x = first * d.x, y = first * d.y, z = first * d.z;
    const auto channel = [&](int k) {
      const auto& h = e.harmonics;
      const F sum = h[0][k] + h[1][k] * y + h[2][k] * z + h[3][k] * x + h[4][k] * xy + h[5][k] * yz +
                    h[6][k] * zz + h[7][k] * xz + h[8][k] * xx;
      return L::most(sum, F{});
    };
    return {channel(0), channel(1), channel(2)};
  }
  [[gnu::always_inline]] static inline T mattFrom(const T& n, const Environment& e) {
    return harmonicsAt(n, L::all(1), L::all(1), e);
  }

  /// d: what is mirrored, n: the normal. The rougher, the nearer to the normal is what a surface mirrors most.
  [[gnu::always_inline]] static inline T mirroredFrom(const T& d, const T& n, F roughness,
                                                      const Environment& e) {
    if (!e.texels) return harmonicsAt(d, 1.5f - 0.5f * roughness, 2.5f - 1.5f * roughness, e);
    const F squared = roughness * roughness;
    const T most = T::mix(d, n, squared * squared);
    const F level = roughness * static_cast<float>(Environment::kMaps - 1);
    const F fine = L::most(L::least(L::floor(level), L::all(Environment::kMaps - 2)), F{});
    const I map = L::truncated(fine);
    const T sharp = lookUp(e.texels, most, By::entry(e.first, map), L::whole(By::entry(e.side, map)));
    const T soft = lookUp(e.texels, most, By::entry(e.first, map + 1), L::whole(By::entry(e.side, map + 1)));
    return T::mix(sharp, soft, level - fine) * L::all(e.intensity);
  }

  /// A map in a direction, blended from four texels.
  [[gnu::always_inline]] static inline T lookUp(const unsigned* texels, const T& d, I first, F side) {
    const F width = L::size(d.x), height = L::size(d.y), per = 1.0f / (width + height + L::size(d.z));
    const F x = d.x * per, y = d.y * per;
    const I below = d.z < 0.0f;
    const auto folded = [](F sign, F other) { return L::select(sign < 0.0f, other - 1.0f, 1.0f - other); };
    const auto place = [&](F at) {
      constexpr float kInside = 1.0f / 256;  // of the edge, so that no texel beyond it counts
      const F on = (at * 0.5f + 0.5f) * side;
      return L::least(L::most(on, L::all(kInside)), side - kInside);  // also where it is no number
    };
    const F u = place(L::select(below, folded(x, L::size(y)), x));
    const F v = place(L::select(below, folded(y, L::size(x)), y));
    const F left = L::floor(u), low = L::floor(v), right = u - left, up = v - low;
    const I row = L::truncated(side) + 1, at = first + L::truncated(low) * row + L::truncated(left);
    const int* from = reinterpret_cast<const int*>(texels);
    I a, b, c, e;
    By::pairs(from, at, a, b);
    By::pairs(from, at + row, c, e);
    return T::mix(T::mix(unpacked(a), unpacked(b), right), T::mix(unpacked(c), unpacked(e), right), up);
  }
  [[gnu::always_inline]] static inline T unpacked(I texel) {
    constexpr int kBias = 127 - 24;
    const F scale = F((((texel >> 27) & 31) + kBias) << 23);
    return {L::whole(texel & 511) * scale, L::whole((texel >> 9) & 511) * scale,
            L::whole((texel >> 18) & 511) * scale};
  }
};

}  // namespace
}  // namespace stadion
