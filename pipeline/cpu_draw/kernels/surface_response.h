#pragma once
/// Light that a surface sends to the eye.
///
/// Linkage  internal.

#include "pipeline/cpu_draw/kernels/light_model.h"
#include "pipeline/cpu_draw/kernels/surroundings.h"

namespace stadion {
namespace {

/// `Number`: of roughness and metallic. float: the same everywhere; By::Floats: one for each fragment.
template <class By, class Number = float>
struct SurfaceResponse : DrawLanes<By> {
  using L = DrawLanes<By>;
  using F = typename L::F;
  using I = typename L::I;
  using T = Triple<F>;
  using Light = LightModel<By>;

  T by, with;   ///< the light is by * base colour + with
  F clearness;  ///< of the air: the part of a further light, as of a glow, that reaches the eye

  struct Finish {
    Number roughness, metallic;
  };

  /// `around`: the part of the light from around that arrives; null: all. `base`: the base colour, if it is
  /// a metal and there is an environment.
  /// `arriving(placed, n, reached)`: the part of the light of the lamp that casts shadows. It is called only
  /// if its light would reach a fragment.
  template <class Arriving>
  [[gnu::always_inline]] inline SurfaceResponse(const FragmentJob& job, const Finish& m, const T& placed,
                                                const T& n, const F* around, const T* base,
                                                const Arriving& arriving) {
    const MaterialParameters& material = *job.material;
    const SceneParameters& scene = *job.scene;
    const T away = T::of(job.view->eye) - placed;
    const F squared = L::most(T::dot(away, away), L::all(1e-12f)), perDistance = L::perRoot(squared);
    const T v = away * perDistance;
    scene.environment ? fromEnvironment(m, *scene.environment, v, n, base) : fromAround(m, scene, v, n);
    if (around) by = by * *around, with = with * *around;
    with = with + T::of(material.emissive) * L::all(material.glow.texels ? 0.0f : 1.0f);
    for (int i = 0; i < scene.lights; ++i) addLamp(i, m, scene, placed, v, n, arriving);
    clearness = L::all(1);
    if (!(scene.perHaze > 0)) return;
    clearness = L::exp2(squared * perDistance * (Light::kPerE * scene.perHaze));
    by = by * clearness;
    with = T::mix(Light::air(v * L::all(-1), scene), with, clearness);
  }

private:
  F nv_;

  [[gnu::always_inline]] static inline F everywhere(float number) { return L::all(number); }
  [[gnu::always_inline]] static inline F everywhere(F numbers) { return numbers; }

  [[gnu::always_inline]] static inline F fifth(F x) {
    const F squared = x * x;
    return squared * squared * x;
  }

  /// Light from the sky and the ground. The mirror's colour is 0.04, of a metal the base colour.
  [[gnu::always_inline]] inline void fromAround(const Finish& m, const SceneParameters& scene, const T& v,
                                                const T& n) {
    const F facing = T::dot(n, v);
    nv_ = L::most(facing, L::all(1e-3f));
    const Number matt = 1.0f - m.metallic, mirror = 0.04f * matt;
    const F grazing = fifth(1.0f - nv_) * ((1.0f - m.roughness) * (1.0f - m.roughness));
    const T reflected = Light::ambientFrom(2.0f * facing * n.z - v.z, scene);
    by =
        Light::ambientFrom(n.z, scene) * everywhere(matt) + reflected * ((m.metallic - grazing) * m.metallic);
    with = reflected * (mirror * m.metallic + (1.0f - mirror) * grazing);
  }

  [[gnu::always_inline]] inline void fromEnvironment(const Finish& m, const EnvironmentParameters& e,
                                                     const T& v, const T& n, const T* base) {
    const F facing = T::dot(n, v);
    nv_ = L::most(facing, L::all(1e-3f));
    const T reflected = n * (2.0f * facing) - v;
    SurroundingLight<By>::respond(e, {everywhere(m.roughness), everywhere(m.metallic), nv_}, n, reflected,
                                  base, by, with);
  }

  template <class Arriving>
  [[gnu::always_inline]] inline void addLamp(int number, const Finish& m, const SceneParameters& scene,
                                             const T& placed, const T& v, const T& n,
                                             const Arriving& arriving) {
    const LightParameters& lamp = scene.light[number];
    T l;
    F strength = Light::strengthAt(lamp, placed, l);
    const F nl = T::dot(n, l);
    const I reached = nl > 0.0f;
    if (L::bits(reached) == 0) return;
    if (number == scene.shadowed) strength *= arriving(placed, n, reached);
    const Number spread = m.roughness * m.roughness, squared = spread * spread, k = 0.5f * spread;
    T h = l + v;
    h = h * L::perRoot(L::most(T::dot(h, h), L::all(1e-12f)));
    const F nh = L::clamp(T::dot(n, h)), lobe = nh * nh * (squared - 1.0f) + 1.0f;
    const F highlight =
        (0.25f * squared) / (lobe * lobe * ((L::most(nl, F{}) * (1.0f - k) + k) * (nv_ * (1.0f - k) + k)));
    const F fresnel = fifth(1.0f - L::clamp(T::dot(l, h))), direct = 1.0f - fresnel;
    const Number matt = 1.0f - m.metallic, mirror = 0.04f * matt;
    const T light = T::of(lamp.colour) * L::where(reached, strength * nl);
    by = by + light * (matt + direct * m.metallic * highlight);
    with = with + light * ((mirror * direct + fresnel) * highlight);
  }
};

}  // namespace
}  // namespace stadion
