#pragma once
/// Light along runs: it is computed at both ends of a run and interpolated between them, where it changes
/// evenly.
///
/// Evenly   no light falls off steeply, the distance changes by at most an eighth, the normal by at most 0.06 rad, highlights are wide,
///          and both ends lie in light, or both in shadow. A pixel between them is shaded by itself if a border of
///          the shadow may be there. No result depends on the other runs that are computed at the same time.
///
/// Linkage  internal.

#include "pipeline/cpu_draw/kernels/surface_interpolation.h"
#include "pipeline/cpu_draw/kernels/surface_response.h"

namespace stadion {
namespace {

template <class By>
struct RunLight : DrawLanes<By> {
  using L = DrawLanes<By>;
  using F = typename L::F;
  using I = typename L::I;
  using T = Triple<F>;
  using Light = LightModel<By>;
  using Batch = FragmentBatch<By>;
  static constexpr int kLanes = By::kLanes;
  static constexpr unsigned kRuns = kLanes / 2;  ///< computed at a time

  /// Whether runs of this material may be interpolated.
  static bool serves(const FragmentJob& job) {
    constexpr float kNarrowestLobe = 0.35f;
    if (job.scene->environment && job.material->metallic > 0)
      return false;  // it mirrors its picture's colours
    return job.runs != 0 && job.material->roughness >= kNarrowestLobe && !job.material->glow.texels &&
           job.scene->steep == 0;
  }

  RunLight(const FragmentJob& job, unsigned first) {
    const Batch b = ends(job, first);
    b.uniform ? compute<true>(job, b) : compute<false>(job, b);
    for (unsigned run = 0; run < kRuns; ++run)
      if (!isEven(2 * run)) state_[2 * run] = kUneven;
  }

  /// Pixels of runs, from `first` on, counted from the first run.
  struct Pixels {
    T by, with;      ///< the light is by * colour of the texture + with
    F alpha, level;  ///< of the surface; of detail
    I even;          ///< whether this holds: else a pixel is shaded by itself
  };
  [[gnu::always_inline]] inline Pixels pixels(const FragmentJob& job, unsigned first) const {
    const I pixel = (L::lanes() + static_cast<int>(first)) & (kRunPixels - 1);
    const F part = L::whole(pixel) * (1.0f / (kRunPixels - 1));
    const unsigned run = first / kRunPixels;
    const auto value = [&](int k) {
      const F from = perRun(values_[k], 2 * run), to = perRun(values_[k], 2 * run + 1);
      return from + (to - from) * part;
    };
    const I state = stateOf(2 * run);
    I even = state != kUneven;
    if (L::bits(I(state == kUnlit) | ~even) != L::kAll) {
      const auto tile = Light::shadowTile(*job.shadow, {value(8), value(9), value(10), F{}});
      even &= I(state == kUnlit) | (I(state == kLight) & tile.light) | (I(state == kDark) & tile.dark);
    }
    return {{value(0), value(1), value(2)}, {value(3), value(4), value(5)}, value(6), value(7), even};
  }

private:
  /// Of an end: its light, or that it is not interpolated.
  static constexpr int kLight = 0, kDark = 1, kUnlit = 2, kUneven = 3;
  static constexpr int kValues = 11;
  alignas(64) float values_[kValues][kLanes];
  alignas(64) float per_[kLanes], normal_[3][kLanes];
  alignas(64) int state_[kLanes];

  /// The first and the last pixel of each run.
  [[gnu::always_inline]] static inline Batch ends(const FragmentJob& job, unsigned first) {
    alignas(64) int pixel[kLanes];
    Batch b;
    b.surface = job.surface + first;
    b.place = nullptr;
    b.shift = 1;
    b.within = 0;
    const unsigned left = 2 * (job.count - first);
    b.count = left < kLanes ? left : kLanes;
    b.uniform = true;
    for (int lane = 0; lane < kLanes; ++lane) {
      pixel[lane] =
          static_cast<int>(job.pixel[first + static_cast<unsigned>(lane / 2)]) + lane % 2 * (kRunPixels - 1);
      b.uniform &= lane >= static_cast<int>(b.count) || b.surfaceOf(lane) == b.surface[0];
    }
    const I at = L::loadInts(pixel);
    b.x = L::whole(at & 0xffff) + 0.5f;
    b.y = L::whole((at >> 16) & 0xffff) + 0.5f;
    return b;
  }

  template <bool kUniform>
  [[gnu::noinline]] void compute(const FragmentJob& job, const Batch& b) {
    const MaterialParameters& m = *job.material;
    const SurfaceInterpolation<By, kUniform> at(job, b);
    const T n = at.normal(), placed = at.three(3);
    I state = I{} + kUnlit;
    typename Light::ShadowPlace place{};
    const SurfaceResponse<By> light(
        job, {m.roughness, m.metallic}, placed, n, nullptr, nullptr,
        [&](const T& where, const T& normal, I reached) {
          place = Light::shadowPlace(*job.shadow, where, normal);
          const auto tile = Light::shadowTile(*job.shadow, place);
          const auto either = [](I which, int one, I other) { return By::select(which, I{} + one, other); };
          const I decided = either(tile.light, kLight, either(tile.dark, kDark, I{} + kUneven));
          state = By::select(reached, decided, state);
          return Light::beyondRings(L::where(tile.light, L::all(1)), place.edge);
        });
    const T by = light.by * (at.three(8) * T::of(m.baseColour));
    const F values[kValues] = {by.x,         by.y,         by.z,       light.with.x,
                               light.with.y, light.with.z, at(11),     m.base.texels ? at.level(m.base) : F{},
                               place.u,      place.v,      place.depth};
    for (int k = 0; k < kValues; ++k) L::store(values_[k], values[k]);
    L::store(per_, at.per), L::store(normal_[0], n.x), L::store(normal_[1], n.y), L::store(normal_[2], n.z);
    L::storeInts(state_, state);
  }

  bool isEven(unsigned from) const {
    const unsigned to = from + 1;
    if (state_[from] != state_[to] || state_[from] == kUneven) return false;
    constexpr float kMostTexels = 64;  // farther apart, they may lie in different rings
    const float right = values_[8][to] - values_[8][from], up = values_[9][to] - values_[9][from];
    if (state_[from] != kUnlit && right * right + up * up > kMostTexels * kMostTexels) return false;
    constexpr float kMostTurn = 0.06f;
    float turn = 0;
    for (const auto& n : normal_) turn += (n[to] - n[from]) * (n[to] - n[from]);
    const float change = per_[to] - per_[from], least = per_[to] < per_[from] ? per_[to] : per_[from];
    return turn <= kMostTurn * kMostTurn && (change < 0 ? -change : change) * 8 <= least;
  }

  [[gnu::always_inline]] inline I stateOf(unsigned at) const {
    I out = I{} + state_[at];
    if constexpr (kLanes > kRunPixels) out = By::select(L::lanes() < kRunPixels, out, I{} + state_[at + 2]);
    return out;
  }
  [[gnu::always_inline]] static inline F perRun(const float* of, unsigned at) {
    F out = L::all(of[at]);
    if constexpr (kLanes > kRunPixels) out = L::select(L::lanes() < kRunPixels, out, L::all(of[at + 2]));
    return out;
  }
};

}  // namespace
}  // namespace stadion
