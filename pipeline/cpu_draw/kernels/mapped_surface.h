#pragma once
/// What the maps of a material say of a surface: its finish, its normal and how much light from around arrives.
///
/// Normals  as in the OpenGL programs (shaders.h).
/// Linkage  internal.

#include "pipeline/cpu_draw/kernels/surface_interpolation.h"

namespace stadion {
namespace {

template <class By, bool kUniform>
struct MappedSurface : DrawLanes<By> {
  using L = DrawLanes<By>;
  using F = typename L::F;
  using I = typename L::I;
  using T = Triple<F>;
  using Filter = TextureFilter<By>;
  using Interpolation = SurfaceInterpolation<By, kUniform>;

  F roughness, metallic;
  F around;  ///< the part of the light from around that arrives
  T normal;  ///< unit, on the side that is seen

  [[gnu::always_inline]] inline MappedSurface(const FragmentJob& job, const Interpolation& at) {
    constexpr float kLeastRoughness = 0.08f;  // as of a material without map
    const MaterialParameters& m = *job.material;
    const bool nearest = job.nearestLevel != 0;
    roughness = L::all(m.roughness);
    metallic = L::all(m.metallic);
    if (m.metallicRoughness.texels) {
      const T read = Filter::at(m.metallicRoughness, at.place(m.metallicRoughness), nearest, false).colour;
      roughness = L::most(roughness * read.y, L::all(kLeastRoughness));
      metallic *= read.z;
    }
    around = L::all(1);
    if (m.occlusion.texels) {
      const T read = Filter::at(m.occlusion, at.place(m.occlusion), nearest, false).colour;
      around = 1.0f + m.occlusionStrength * (read.x - 1.0f);
    }
    normal = m.normal.texels ? bumped(m, at, nearest) : at.normal();
  }

private:
  /// A direction along the surface, and the side of the bitangent.
  struct Tangent {
    T along;
    F side;
  };

  [[gnu::always_inline]] static inline T cross(const T& a, const T& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
  }
  [[gnu::always_inline]] static inline F signOf(F x) { return L::select(x < 0.0f, L::all(-1), L::all(1)); }
  /// The change of a number from the first corner to another.
  [[gnu::always_inline]] static inline T place(const Interpolation& at, int corner) {
    return {at.of[15 + 12 * corner], at.of[16 + 12 * corner], at.of[17 + 12 * corner]};
  }

  /// The triangle's own: how places change with texture coordinates.
  [[gnu::always_inline]] static inline Tangent ofTriangle(const TextureParameters& map,
                                                          const Interpolation& at, const T& n) {
    const auto uvs = at.uvsOf(map);
    const float* m = map.transform;
    const F a1 = uvs.u.y - uvs.u.x, a2 = uvs.u.z - uvs.u.x;
    const F b1 = uvs.v.y - uvs.v.x, b2 = uvs.v.z - uvs.v.x;
    const F u1 = m[0] * a1 + m[1] * b1, u2 = m[0] * a2 + m[1] * b2;
    const F v1 = m[3] * a1 + m[4] * b1, v2 = m[3] * a2 + m[4] * b2;
    const T p1 = place(at, 1) - place(at, 0), p2 = place(at, 2) - place(at, 0);
    const F turns = signOf(u1 * v2 - u2 * v1);
    const T along = (p1 * v2 - p2 * v1) * turns, down = (p2 * u1 - p1 * u2) * turns;
    return {along, L::select(T::dot(cross(n, along), down) > 0.0f, L::all(-1), L::all(1))};
  }
  /// That of the file, where it has one.
  [[gnu::always_inline]] static inline void takeFileTangent(const Interpolation& at, Tangent& t) {
    const T along{at.within(at.extra(0)), at.within(at.extra(1)), at.within(at.extra(2))};
    const I has = T::dot(along, along) > 0.01f;
    t.side = L::select(has, signOf(at.within(at.extra(3))), t.side);
    t.along = {L::select(has, along.x, t.along.x), L::select(has, along.y, t.along.y),
               L::select(has, along.z, t.along.z)};
  }

  [[gnu::always_inline]] static inline T bumped(const MaterialParameters& m, const Interpolation& at,
                                                bool nearest) {
    T n = at.three(0);
    n = n * L::perRoot(L::most(T::dot(n, n), L::all(1e-30f)));
    Tangent t = ofTriangle(m.normal, at, n);
    if (m.tangents) takeFileTangent(at, t);
    T x = t.along - n * T::dot(n, t.along);
    x = x * L::perRoot(L::most(T::dot(x, x), L::all(1e-30f)));
    const T read = Filter::at(m.normal, at.place(m.normal), nearest, false).colour;
    const F right = (2.0f * read.x - 1.0f) * m.normalScale, up = (2.0f * read.y - 1.0f) * m.normalScale;
    const T bent = x * right + cross(n, x) * (t.side * up) + n * (2.0f * read.z - 1.0f);
    const F squared = T::dot(bent, bent);
    const I serves = squared > 1e-12f;
    const T unit = bent * L::perRoot(L::most(squared, L::all(1e-12f)));
    return T{L::select(serves, unit.x, n.x), L::select(serves, unit.y, n.y), L::select(serves, unit.z, n.z)} *
           at.of[11];
  }
};

}  // namespace
}  // namespace stadion
