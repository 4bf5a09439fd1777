#pragma once
/// Values of triangles' corners, interpolated at fragments.
///
/// Linkage  internal.

#include "pipeline/cpu_draw/kernels/fragment_batch.h"
#include "pipeline/cpu_draw/kernels/texture_filter.h"

namespace stadion {
namespace {

/// The surface blocks of a batch, by column.
template <class By, bool kUniform>
struct SurfaceColumns : DrawLanes<By> {
  using F = typename DrawLanes<By>::F;
  const float* one;
  F columns[kUniform ? 1 : kSurfaceFloats];

  [[gnu::always_inline]] inline SurfaceColumns(const FragmentJob& job, const FragmentBatch<By>& b) {
    one = job.surfaces[b.surface[0]].at;
    if constexpr (!kUniform)
      for (int first = 0; first < kSurfaceFloats; first += 4)
        By::columns([&](int lane) { return job.surfaces[b.surfaceOf(lane)].at + first; }, columns + first);
  }
  [[gnu::always_inline]] inline F operator[](int k) const {
    if constexpr (kUniform)
      return F{} + one[k];
    else
      return columns[k];
  }
};

template <class By, bool kUniform>
struct SurfaceInterpolation : DrawLanes<By> {
  using L = DrawLanes<By>;
  using F = typename L::F;
  using T = Triple<F>;
  using Filter = TextureFilter<By>;

  const SurfaceExtra* extras;
  const unsigned* surface;  ///< of the extras: by lane >> shift
  int shift;
  SurfaceColumns<By, kUniform> of;
  F first, second, third, per;

  [[gnu::always_inline]] inline SurfaceInterpolation(const FragmentJob& job, const FragmentBatch<By>& b)
      : extras(job.extras), surface(b.surface), shift(b.shift), of(job, b) {
    const F x = b.x - of[3], y = b.y - of[7];
    // The middle of a pixel may lie beside the triangle that covers one of its samples.
    first = L::most(of[0] * x + of[1] * y + of[2], F{});
    second = L::most(of[4] * x + of[5] * y + of[6], F{});
    third = L::most(of[8] * x + of[9] * y + of[10], F{});
    per = 1.0f / L::most(first + second + third, L::all(1e-30f));
    first *= per;
    second *= per;
    third *= per;
  }
  [[gnu::always_inline]] inline F operator()(int k) const {
    return first * of[12 + k] + second * of[24 + k] + third * of[36 + k];
  }
  [[gnu::always_inline]] inline T three(int k) const { return {(*this)(k), (*this)(k + 1), (*this)(k + 2)}; }
  /// A number of the corners of each lane's triangle, from their extras.
  [[gnu::always_inline]] inline T extra(int k) const {
    T out;
    cornersOf(extras, surface, shift, k, out);
    return out;
  }
  [[gnu::always_inline]] inline F within(const T& corners) const {
    return first * corners.x + second * corners.y + third * corners.z;
  }
  /// Texture coordinates of the corners.
  struct Uvs {
    T u, v;
  };
  [[gnu::always_inline]] inline Uvs uvsOf(const TextureParameters& t) const {
    if (t.coordinates == 0) return {{of[18], of[30], of[42]}, {of[19], of[31], of[43]}};
    return {extra(4), extra(5)};
  }
  [[gnu::always_inline]] inline typename Filter::Coordinates coordinates(const TextureParameters& t) const {
    const Uvs uvs = uvsOf(t);
    const F u = within(uvs.u), v = within(uvs.v);
    const float* m = t.transform;
    return {m[0] * u + m[1] * v + m[2], m[3] * u + m[4] * v + m[5]};
  }
  [[gnu::always_inline]] inline F level(const TextureParameters& t) const {
    const Uvs uvs = uvsOf(t);
    const F u = within(uvs.u), v = within(uvs.v);
    const F ux = slope(uvs.u, u, 0), uy = slope(uvs.u, u, 1), vx = slope(uvs.v, v, 0),
            vy = slope(uvs.v, v, 1);
    const float* m = t.transform;
    return Filter::levelOf(
        t, {m[0] * ux + m[1] * vx, m[3] * ux + m[4] * vx, m[0] * uy + m[1] * vy, m[3] * uy + m[4] * vy});
  }
  [[gnu::always_inline]] inline typename Filter::Place place(const TextureParameters& t) const {
    const typename Filter::Coordinates c = coordinates(t);
    return {c, level(t)};
  }
  /// The normal, unit, on the side that is seen.
  [[gnu::always_inline]] inline T normal() const {
    const T n = three(0);
    return n * (L::perRoot(L::most(T::dot(n, n), L::all(1e-30f))) * of[11]);
  }

private:
  /// A function of its own, so that shading without extras stays small.
  [[gnu::noinline]] static void cornersOf(const SurfaceExtra* extras, const unsigned* surface, int shift,
                                          int k, T& out) {
    alignas(64) float corner[3][By::kLanes];
    for (int lane = 0; lane < By::kLanes; ++lane)
      for (int c = 0; c < 3; ++c)
        corner[c][lane] = extras[surface[kUniform ? 0 : lane >> shift]].at[kExtraVertexFloats * c + k];
    out = {L::load(corner[0]), L::load(corner[1]), L::load(corner[2])};
  }
  /// The change of a value for a pixel along x (0) or y (1). `corners`: the value at each of them.
  [[gnu::always_inline]] inline F slope(const T& corners, F here, int axis) const {
    return (of[axis] * (corners.x - here) + of[4 + axis] * (corners.y - here) +
            of[8 + axis] * (corners.z - here)) *
           per;
  }
};

}  // namespace
}  // namespace stadion
