#pragma once
/// Curves that make colours of light (pipeline/shader/shaders.h names their sources).
///
/// Linkage  internal.

#include "pipeline/cpu_draw/kernels/lanes.h"

namespace stadion {
namespace {

template <class By>
struct ToneCurves : DrawLanes<By> {
  using L = DrawLanes<By>;
  using F = typename L::F;
  using I = typename L::I;
  using T = Triple<F>;

  [[gnu::always_inline]] static inline F softClip(F c) {
    if (L::bits(~I(c <= 0.8f)) == 0) return c;
    const F over = L::most(c - 0.8f, F{}) * 5.0f;
    return L::least(c, L::all(0.8f)) + 0.2f * over / (1.0f + over);
  }

  [[gnu::noinline]] static T shown(const T& light, float exposure, int curve) {
    const T c = light * L::all(exposure);
    if (curve == 1) return {L::clamp(c.x), L::clamp(c.y), L::clamp(c.z)};
    if (curve == 2) return neutral(c);
    if (curve == 3) return {aces(c.x), aces(c.y), aces(c.z)};
    return {softClip(c.x), softClip(c.y), softClip(c.z)};
  }

private:
  [[gnu::always_inline]] static inline F aces(F x) {
    return L::clamp((x * (2.51f * x + 0.03f)) / (x * (2.43f * x + 0.59f) + 0.14f));
  }

  [[gnu::always_inline]] static inline T neutral(T c) {
    constexpr float kStart = 0.76f, kRoom = 1 - kStart, kDesaturation = 0.15f;
    const F x = L::least(c.x, L::least(c.y, c.z));
    const F offset = L::select(x < 0.08f, x - 6.25f * x * x, L::all(0.04f));
    c = {c.x - offset, c.y - offset, c.z - offset};
    const F peak = L::most(c.x, L::most(c.y, c.z));
    const F most = L::most(peak, L::all(kStart));  // the curve begins there, so lower peaks stay
    const F bent = 1.0f - kRoom * kRoom / (most + kRoom - kStart);
    const F white = 1.0f - 1.0f / (kDesaturation * (most - bent) + 1.0f);
    const T scaled = c * (bent / most);
    const I bends = peak >= kStart;
    const auto mixed = [&](F from, F low) { return L::select(bends, from + (bent - from) * white, low); };
    return {mixed(scaled.x, c.x), mixed(scaled.y, c.y), mixed(scaled.z, c.z)};
  }
};

}  // namespace
}  // namespace stadion
