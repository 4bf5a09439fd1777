#pragma once
/// Colours of fragments: surfaces and the sky.
///
/// Linkage  internal.

#include "pipeline/cpu_draw/kernels/light_model.h"
#include "pipeline/cpu_draw/kernels/texture_filter.h"

namespace stadion {
namespace {

template <class By>
struct SurfaceShading : DrawLanes<By> {
  using L = DrawLanes<By>;
  using F = typename L::F;
  using I = typename L::I;
  using T = Triple<F>;
  using Light = LightModel<By>;
  using Filter = TextureFilter<By>;
  static constexpr int kLanes = By::kLanes;

  /// Some fragments of a job, or a run. Lanes beyond its end have any fragments.
  struct Batch {
    F x, y;  ///< middles of the pixels
    const unsigned *surface, *place;
    unsigned count;
    bool uniform;  ///< all on one triangle
  };
  [[gnu::always_inline]] static inline Batch batch(const FragmentJob& job, unsigned first) {
    Batch b;
    b.surface = job.surface + first, b.place = job.place + first;
    b.count = job.count - first < kLanes ? job.count - first : kLanes;
    const I pixel = L::loadInts(job.pixel + first), surface = L::loadInts(b.surface);
    b.x = L::whole(pixel & 0xffff) + 0.5f, b.y = L::whole((pixel >> 16) & 0xffff) + 0.5f;
    const I differs = surface != I{} + static_cast<int>(b.surface[0]);
    b.uniform = (L::bits(differs) & (L::kAll >> (kLanes - b.count))) == 0;
    return b;
  }
  [[gnu::always_inline]] static inline Batch run(const FragmentJob& job, unsigned number) {
    Batch b;
    b.surface = job.surface + number, b.place = job.place + number, b.count = kLanes, b.uniform = true;
    const unsigned pixel = job.pixel[number];
    b.x = L::whole(I{} + static_cast<int>(pixel & 0xffff) + L::lanes()) + 0.5f;
    b.y = L::all(static_cast<float>(pixel >> 16) + 0.5f);
    return b;
  }

  /// Red, green, blue and alpha.
  struct Colour {
    F column[4];
  };
  [[gnu::always_inline]] static inline void put(const FragmentJob& job, const Batch& b, const Colour& c) {
    if (job.runs != 0) {
      float* to = job.colours + 4 * static_cast<unsigned long>(b.place[0]);
      By::rows(c.column, [&](int lane) { return to + 4 * lane; });
    } else if (b.count == kLanes) {
      By::rows(c.column,
               [&](int lane) { return job.colours + 4 * static_cast<unsigned long>(b.place[lane]); });
    } else {
      alignas(64) float colours[4 * kLanes];
      By::rows(c.column, [&](int lane) { return colours + 4 * lane; });
      for (unsigned lane = 0; lane < b.count; ++lane)
        __builtin_memcpy(job.colours + 4 * static_cast<unsigned long>(b.place[lane]), colours + 4 * lane,
                         4 * sizeof(float));
    }
  }
  /// Calls shader(batch) for all fragments and keeps the colours that it returns.
  template <class Shader>
  [[gnu::always_inline]] static inline void shadeAll(const FragmentJob& job, const Shader& shader) {
    const unsigned step = job.runs != 0 ? 1 : kLanes;
    for (unsigned i = 0; i < job.count; i += step) {
      const Batch b = job.runs != 0 ? run(job, i) : batch(job, i);
      put(job, b, shader(b));
    }
  }

  /// The surface blocks of a batch, by column.
  template <bool kUniform>
  struct Columns {
    const float* one;
    F columns[kUniform ? 1 : kSurfaceFloats];

    [[gnu::always_inline]] inline explicit Columns(const FragmentJob& job, const Batch& b) {
      one = job.surfaces[b.surface[0]].at;
      if constexpr (!kUniform)
        for (int first = 0; first < kSurfaceFloats; first += 4)
          By::columns([&](int lane) { return job.surfaces[b.surface[lane]].at + first; }, columns + first);
    }
    [[gnu::always_inline]] inline F operator[](int k) const {
      if constexpr (kUniform)
        return F{} + one[k];
      else
        return columns[k];
    }
  };

  /// Values of the corners, interpolated at the middles of pixels.
  template <bool kUniform>
  struct Interpolation {
    Columns<kUniform> of;
    F first, second, third, per;

    [[gnu::always_inline]] inline Interpolation(const FragmentJob& job, const Batch& b) : of(job, b) {
      const F x = b.x - of[3], y = b.y - of[7];
      // The middle of a pixel may lie beside the triangle that covers one of its samples.
      first = L::most(of[0] * x + of[1] * y + of[2], F{}),
      second = L::most(of[4] * x + of[5] * y + of[6], F{});
      third = L::most(of[8] * x + of[9] * y + of[10], F{});
      per = 1.0f / L::most(first + second + third, L::all(1e-30f));
      first *= per, second *= per, third *= per;
    }
    [[gnu::always_inline]] inline F operator()(int k) const {
      return first * of[12 + k] + second * of[24 + k] + third * of[36 + k];
    }
    [[gnu::always_inline]] inline T three(int k) const {
      return {(*this)(k), (*this)(k + 1), (*this)(k + 2)};
    }
    /// The change of a value for a pixel along x (0) or y (1).
    [[gnu::always_inline]] inline F slope(int k, F here, int axis) const {
      return (of[axis] * (of[12 + k] - here) + of[4 + axis] * (of[24 + k] - here) +
              of[8 + axis] * (of[36 + k] - here)) *
             per;
    }
    [[gnu::always_inline]] inline typename Filter::Place place(const TextureParameters& t) const {
      const F u = (*this)(6), v = (*this)(7);
      const F ux = slope(6, u, 0), uy = slope(6, u, 1), vx = slope(7, v, 0), vy = slope(7, v, 1);
      const float* m = t.transform;
      return {m[0] * u + m[1] * v + m[2], m[3] * u + m[4] * v + m[5], m[0] * ux + m[1] * vx,
              m[3] * ux + m[4] * vx,      m[0] * uy + m[1] * vy,      m[3] * uy + m[4] * vy};
    }
  };

  /// Base colour and alpha.
  struct Base {
    T colour;
    F alpha;
  };
  template <bool kUniform>
  [[gnu::always_inline]] static inline Base base(const FragmentJob& job, const Interpolation<kUniform>& at,
                                                 bool roots) {
    const MaterialParameters& m = *job.material;
    Base b{at.three(8) * T::of(m.baseColour), at(11)};
    if (m.base.texels) {
      const typename Filter::Texel t = Filter::at(m.base, at.place(m.base), job.nearestLevel != 0, roots);
      b.colour = b.colour * t.colour, b.alpha *= t.alpha;
    }
    return b;
  }

  template <bool kUniform>
  [[gnu::always_inline]] static inline Colour shadeBatch(const FragmentJob& job, const Batch& b) {
    const MaterialParameters& m = *job.material;
    const SceneParameters& scene = *job.scene;
    const Interpolation<kUniform> at(job, b);
    const Base surface = base(job, at, true);
    T emitted = T::of(m.emissive);
    if (m.glow.texels)
      emitted = emitted * Filter::at(m.glow, at.place(m.glow), job.nearestLevel != 0, true).colour;
    const T placed = at.three(3), away = T::of(job.view->eye) - placed;
    const F squared = L::most(T::dot(away, away), L::all(1e-12f));
    const F perDistance = L::perRoot(squared);
    const T v = away * perDistance;
    T n = at.three(0);
    n = n * (L::perRoot(L::most(T::dot(n, n), L::all(1e-30f))) * at.of[11]);

    T light = lit(job, m, surface.colour, placed, v, n) + emitted;
    if (scene.perHaze > 0) {
      const F clearness = L::exp2(squared * perDistance * (Light::kPerE * scene.perHaze));
      light = T::mix(Light::air(v * L::all(-1), scene), light, clearness);
    }
    light = Light::softClip(light);
    return {{light.x, light.y, light.z, L::clamp(surface.alpha)}};
  }

  [[gnu::always_inline]] static inline F fifth(F x) {
    const F squared = x * x;
    return squared * squared * x;
  }

  /// Reflected light.
  [[gnu::always_inline]] static inline T lit(const FragmentJob& job, const MaterialParameters& m,
                                             const T& base, const T& placed, const T& v, const T& n) {
    const SceneParameters& scene = *job.scene;
    const T diffuse = base * L::all(1 - m.metallic);
    const T mirror = T::mix(T::of(0.04f), base, L::all(m.metallic));
    const T rest = T::of(1.0f) - mirror;
    const F facing = T::dot(n, v), nv = L::most(facing, L::all(1e-3f));
    const F grazing = fifth(1.0f - nv) * ((1 - m.roughness) * (1 - m.roughness));
    T light =
        diffuse * Light::ambientFrom(n.z, scene) +
        (mirror * L::all(m.metallic) + rest * grazing) * Light::ambientFrom(2.0f * facing * n.z - v.z, scene);
    const float spread = m.roughness * m.roughness, squared = spread * spread, k = 0.5f * spread;
    const F seen = nv * (1 - k) + k;
    for (int i = 0; i < scene.lights; ++i) {
      const LightParameters& lamp = scene.light[i];
      T l;
      F strength = Light::strengthAt(lamp, placed, l);
      const F nl = T::dot(n, l);
      const I reached = nl > 0.0f;
      if (L::bits(reached) == 0) continue;
      if (i == scene.shadowed) strength *= Light::lightArriving(*job.shadow, placed, n);
      T h = l + v;
      h = h * L::perRoot(L::most(T::dot(h, h), L::all(1e-12f)));
      const F nh = L::clamp(T::dot(n, h));
      const F lobe = nh * nh * (squared - 1) + 1.0f;
      const F highlight = (0.25f * squared) / (lobe * lobe * ((L::most(nl, F{}) * (1 - k) + k) * seen));
      const T fresnel = mirror + rest * fifth(1.0f - L::clamp(T::dot(l, h)));
      light = light + (diffuse + fresnel * highlight) * T::of(lamp.colour) * L::where(reached, strength * nl);
    }
    return light;
  }

  template <bool kUniform>
  [[gnu::always_inline]] static inline Colour shadePlainBatch(const FragmentJob& job, const Batch& b) {
    const MaterialParameters& m = *job.material;
    const SceneParameters& scene = *job.scene;
    const Interpolation<kUniform> at(job, b);
    T colour = at.three(8);
    F alpha = at(11);
    if (m.base.texels) {
      const typename Filter::Texel t = Filter::at(m.base, at.place(m.base), job.nearestLevel != 0, false);
      colour = colour * t.colour, alpha *= t.alpha;
    }
    if (m.glow.texels) {
      const T glow = Filter::at(m.glow, at.place(m.glow), job.nearestLevel != 0, false).colour;
      colour = colour + T::of(m.emissive) * glow;
      const F one = L::all(1);
      colour = {L::least(colour.x, one), L::least(colour.y, one), L::least(colour.z, one)};
    }
    if (scene.perHaze > 0) colour = T::mix(T::of(scene.horizon), colour, at(0));
    return {{colour.x, colour.y, colour.z, L::clamp(alpha)}};
  }

  template <bool kUniform>
  [[gnu::always_inline]] static inline I presentIn(const FragmentJob& job, const Batch& b) {
    const MaterialParameters& m = *job.material;
    const Interpolation<kUniform> at(job, b);
    F alpha = at(11);
    if (m.base.texels) alpha *= Filter::at(m.base, at.place(m.base), job.nearestLevel != 0, false).alpha;
    return ~I(alpha < m.alphaCutoff);
  }

  static void shade(const FragmentJob& job) {
    shadeAll(job, [&](const Batch& b) {
      return b.uniform ? shadeBatch<true>(job, b) : shadeBatch<false>(job, b);
    });
  }
  static void shadePlain(const FragmentJob& job) {
    shadeAll(job, [&](const Batch& b) {
      return b.uniform ? shadePlainBatch<true>(job, b) : shadePlainBatch<false>(job, b);
    });
  }
  static void cutOut(const FragmentJob& job, int* present) {
    for (unsigned i = 0; i < job.count; i += kLanes) {
      const Batch b = batch(job, i);
      L::storeInts(present + i, b.uniform ? presentIn<true>(job, b) : presentIn<false>(job, b));
    }
  }

  /// The direction in which a pixel's middle lies, unit.
  [[gnu::always_inline]] static inline T direction(const ViewParameters& view, const Batch& b) {
    const T d = T::of(view.ray) + T::of(view.rayX) * b.x + T::of(view.rayY) * b.y;
    return d * L::perRoot(L::most(T::dot(d, d), L::all(1e-30f)));
  }
  /// The share of the ground in an endless plain in thin haze.
  [[gnu::always_inline]] static inline F groundShare(const T& d) {
    return L::exp2(0.03f / L::least(d.z, L::all(-1e-4f)));
  }
  [[gnu::always_inline]] static inline T either(I m, const T& a, const T& b) {
    return {L::select(m, a.x, b.x), L::select(m, a.y, b.y), L::select(m, a.z, b.z)};
  }

  static void sky(const FragmentJob& job) {
    const SceneParameters& s = *job.scene;
    shadeAll(job, [&](const Batch& b) -> Colour {
      const T d = direction(*job.view, b), air = Light::air(d, s);
      const F off = L::most(1.0f - T::dot(d, T::of(s.sunDirection)), F{});
      const F t = L::clamp((off - 6.0e-5f) * (1 / 3.0e-5f));
      const F disc = (1.0f - t * t * (3.0f - 2.0f * t)) * (3.0f * s.sunShare);
      const T above = air + T::of(s.sunColour) * disc;
      const T below = T::mix(air, T::of(s.ground), groundShare(d));
      const T sky = Light::softClip(either(d.z >= 0.0f, above, below));
      return {{sky.x, sky.y, sky.z, L::all(1)}};
    });
  }
  static void skyPlain(const FragmentJob& job) {
    const SceneParameters& s = *job.scene;
    shadeAll(job, [&](const Batch& b) -> Colour {
      const T d = direction(*job.view, b);
      const T below = T::mix(T::of(s.horizon), T::of(s.ground), groundShare(d));
      const T sky = either(d.z >= 0.0f, Light::airWithoutGlow(d, s), below);
      return {{sky.x, sky.y, sky.z, L::all(1)}};
    });
  }
};

}  // namespace
}  // namespace stadion
