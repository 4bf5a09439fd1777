#pragma once
/// Colours of fragments: surfaces and the sky.
///
/// Linkage  internal.

#include "pipeline/cpu_draw/kernels/mapped_surface.h"
#include "pipeline/cpu_draw/kernels/run_light.h"

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
  using Batch = FragmentBatch<By>;
  using Colour = typename Batch::Colour;
  template <bool kUniform>
  using Interpolation = SurfaceInterpolation<By, kUniform>;
  static constexpr int kLanes = By::kLanes;

  [[gnu::always_inline]] static inline Colour encodable(const FragmentJob& job, const T& light, F alpha) {
    const T c = Light::shown(light, *job.scene);
    return {{c.x, c.y, c.z, L::clamp(alpha)}};
  }

  template <bool kUniform>
  [[gnu::always_inline]] static inline Colour shadeBatch(const FragmentJob& job, const Batch& b) {
    const MaterialParameters& m = *job.material;
    const Interpolation<kUniform> at(job, b);
    const MirroredColour<Interpolation<kUniform>> mirrored(job, at);
    const SurfaceResponse<By> response(job, {m.roughness, m.metallic}, at.three(3), at.normal(), nullptr,
                                       mirrored.colour, Arriving{job});
    return coloured(job, at, response);
  }
  /// The colour that a metal mirrors its surroundings with. What is no metal needs none.
  template <class At>
  struct MirroredColour {
    T base;
    const T* colour = nullptr;
    [[gnu::always_inline]] inline MirroredColour(const FragmentJob& job, const At& at) {
      const MaterialParameters& m = *job.material;
      if (!job.scene->environment || !(m.metallic > 0)) return;
      base = at.three(8) * T::of(m.baseColour);
      if (m.base.texels)
        base = base * Filter::at(m.base, at.place(m.base), job.nearestLevel != 0, true).colour;
      colour = &base;
    }
  };
  /// The part of the light that arrives through shadows.
  struct Arriving {
    const FragmentJob& job;
    [[gnu::always_inline]] inline F operator()(const T& placed, const T& n, I) const {
      return Light::lightArriving(*job.shadow, Light::shadowPlace(*job.shadow, placed, n));
    }
  };

  /// With what the surface's maps say of its finish, its normal and occlusion.
  template <bool kUniform>
  [[gnu::always_inline]] static inline Colour shadeMapped(const FragmentJob& job, const Batch& b) {
    const Interpolation<kUniform> at(job, b);
    const MappedSurface<By, kUniform> surface(job, at);
    const MirroredColour<Interpolation<kUniform>> mirrored(job, at);
    const SurfaceResponse<By, F> response(job, {surface.roughness, surface.metallic}, at.three(3),
                                          surface.normal, &surface.around, mirrored.colour, Arriving{job});
    return coloured(job, at, response);
  }

  template <bool kUniform>
  [[gnu::always_inline]] static inline Colour shadeUnlit(const FragmentJob& job, const Batch& b) {
    const MaterialParameters& m = *job.material;
    const SceneParameters& scene = *job.scene;
    const Interpolation<kUniform> at(job, b);
    T colour = at.three(8) * T::of(m.baseColour);
    F alpha = at(11);
    if (m.base.texels) {
      const typename Filter::Texel t = Filter::at(m.base, at.place(m.base), job.nearestLevel != 0, true);
      colour = colour * t.colour;
      alpha *= t.alpha;
    }
    if (scene.perHaze > 0) {
      const T away = T::of(job.view->eye) - at.three(3);
      const F squared = L::most(T::dot(away, away), L::all(1e-12f)), perDistance = L::perRoot(squared);
      const F clearness = L::exp2(squared * perDistance * (Light::kPerE * scene.perHaze));
      const T behind = Light::shown(Light::air(away * (perDistance * -1.0f), scene), scene);
      colour = T::mix(behind, colour, clearness);
    }
    return {{colour.x, colour.y, colour.z, L::clamp(alpha)}};
  }

  /// `response`: the light of a surface, which its pictures colour.
  template <class At, class Response>
  [[gnu::always_inline]] static inline Colour coloured(const FragmentJob& job, const At& at,
                                                       const Response& response) {
    const MaterialParameters& m = *job.material;
    T colour = at.three(8) * T::of(m.baseColour), light = response.with;
    F alpha = at(11);
    if (m.base.texels) {
      const typename Filter::Texel t = Filter::at(m.base, at.place(m.base), job.nearestLevel != 0, true);
      colour = colour * t.colour;
      alpha *= t.alpha;
    }
    if (m.glow.texels) {
      const T glow = Filter::at(m.glow, at.place(m.glow), job.nearestLevel != 0, true).colour;
      light = light + T::of(m.emissive) * glow * response.clearness;
    }
    return encodable(job, response.by * colour + light, alpha);
  }

  /// Pixels of runs whose light changes evenly.
  [[gnu::always_inline]] static inline Colour shadeEvenly(const FragmentJob& job, const Batch& b,
                                                          const typename RunLight<By>::Pixels& pixels) {
    const TextureParameters& base = job.material->base;
    T light = pixels.by;
    F alpha = pixels.alpha;
    if (base.texels) {
      const auto at = b.uniform ? coordinates<true>(job, b) : coordinates<false>(job, b);
      const typename Filter::Texel t = Filter::at(base, {at, pixels.level}, job.nearestLevel != 0, true);
      light = light * t.colour;
      alpha *= t.alpha;
    }
    return encodable(job, light + pixels.with, alpha);
  }
  template <bool kUniform>
  [[gnu::always_inline]] static inline typename Filter::Coordinates coordinates(const FragmentJob& job,
                                                                                const Batch& b) {
    return Interpolation<kUniform>(job, b).coordinates(job.material->base);
  }

  [[gnu::noinline]] static Colour shadeEach(const FragmentJob& job, const Batch& b) {
    return b.uniform ? shadeBatch<true>(job, b) : shadeBatch<false>(job, b);
  }

  static void shadeRuns(const FragmentJob& job) {
    constexpr unsigned kRuns = RunLight<By>::kRuns;
    for (unsigned first = 0; first < job.count; first += kRuns) {
      const RunLight<By> light(job, first);
      const unsigned count = job.count - first < kRuns ? job.count - first : kRuns;
      for (unsigned i = 0; i < kRunPixels * count; i += kLanes) {
        const Batch b = Batch::runs(job, kRunPixels * first + i);
        const typename RunLight<By>::Pixels pixels = light.pixels(job, i);
        const unsigned even = L::bits(pixels.even);
        if (even == 0) {
          b.put(job, shadeEach(job, b));
          continue;
        }
        Colour c = shadeEvenly(job, b, pixels);
        if (even != L::kAll) {
          const Colour each = shadeEach(job, b);
          for (int k = 0; k < 4; ++k) c.column[k] = L::select(pixels.even, c.column[k], each.column[k]);
        }
        b.put(job, c);
      }
    }
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
      colour = colour * t.colour;
      alpha *= t.alpha;
    }
    if (m.glow.texels && !m.unlit) {
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
    if (job.material->unlit)
      return Batch::shadeAll(job, [&](const Batch& b) {
        return b.uniform ? shadeUnlit<true>(job, b) : shadeUnlit<false>(job, b);
      });
    if (job.material->mapped)
      return Batch::shadeAll(job, [&](const Batch& b) {
        return b.uniform ? shadeMapped<true>(job, b) : shadeMapped<false>(job, b);
      });
    if (RunLight<By>::serves(job)) return shadeRuns(job);
    Batch::shadeAll(job, [&](const Batch& b) { return shadeEach(job, b); });
  }
  static void shadePlain(const FragmentJob& job) {
    Batch::shadeAll(job, [&](const Batch& b) {
      return b.uniform ? shadePlainBatch<true>(job, b) : shadePlainBatch<false>(job, b);
    });
  }
  static void cutOut(const FragmentJob& job, int* present) {
    for (unsigned i = 0; i < job.count; i += kLanes) {
      const Batch b = Batch::ones(job, i);
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

  static void background(const FragmentJob& job) {
    const SceneParameters& s = *job.scene;
    Batch::shadeAll(job, [&](const Batch& b) -> Colour {
      const T c = Light::shown(SurroundingLight<By>::picture(direction(*job.view, b), *s.environment), s);
      return {{c.x, c.y, c.z, L::all(1)}};
    });
  }
  static void sky(const FragmentJob& job) {
    const SceneParameters& s = *job.scene;
    if (s.environment && s.environment->picture) return background(job);
    Batch::shadeAll(job, [&](const Batch& b) -> Colour {
      const T d = direction(*job.view, b), air = Light::air(d, s);
      const F off = L::most(1.0f - T::dot(d, T::of(s.sunDirection)), F{});
      const F t = L::clamp((off - 6.0e-5f) * (1 / 3.0e-5f));
      const F disc = (1.0f - t * t * (3.0f - 2.0f * t)) * (3.0f * s.sunShare);
      const T above = air + T::of(s.sunColour) * disc;
      const T below = T::mix(air, T::of(s.ground), groundShare(d));
      const T sky = Light::shown(either(d.z >= 0.0f, above, below), s);
      return {{sky.x, sky.y, sky.z, L::all(1)}};
    });
  }
  static void skyPlain(const FragmentJob& job) {
    const SceneParameters& s = *job.scene;
    Batch::shadeAll(job, [&](const Batch& b) -> Colour {
      const T d = direction(*job.view, b);
      const T below = T::mix(T::of(s.horizon), T::of(s.ground), groundShare(d));
      const T sky = either(d.z >= 0.0f, Light::airWithoutGlow(d, s), below);
      return {{sky.x, sky.y, sky.z, L::all(1)}};
    });
  }
};

}  // namespace
}  // namespace stadion
