#pragma once
/// What shading needs of visible triangles: weights of the corners, and the corners in World axes.
///
/// Linkage  internal.

#include "pipeline/cpu_draw/kernels/kernel_data.h"
#include "pipeline/cpu_draw/kernels/lanes.h"

namespace stadion {
namespace {

template <class By>
struct SurfaceMaking : DrawLanes<By> {
  using L = DrawLanes<By>;
  using F = typename L::F;
  using I = typename L::I;
  using T = Triple<F>;
  static constexpr int kLanes = By::kLanes;

  /// Some triangles of a job. Lanes beyond its end repeat the last one.
  struct Batch {
    const TriangleRecord* triangle[kLanes];
    int corner[3][kLanes];
    alignas(64) int left[kLanes], low[kLanes];
    alignas(64) float facing[kLanes];
    int count;
  };
  [[gnu::always_inline]] static inline Batch batch(const SurfaceJob& job, unsigned first) {
    Batch b;
    b.count = job.count - first < kLanes ? static_cast<int>(job.count - first) : kLanes;
    for (int lane = 0; lane < kLanes; ++lane) {
      const TriangleRecord& t =
          *job.triangles[first + static_cast<unsigned>(lane < b.count ? lane : b.count - 1)];
      b.corner[0][lane] = job.corners.a[t.triangle];
      b.corner[1][lane] = job.corners.b[t.triangle];
      b.corner[2][lane] = job.corners.c[t.triangle];
      b.left[lane] = t.left;
      b.low[lane] = t.low;
      b.facing[lane] = (t.sourceAndFlags & kFacesAway) != 0 ? -1.0f : 1.0f;
    }
    return b;
  }

  /// A row of a matrix with `kColumns` of them, times a vector.
  template <int kColumns>
  [[gnu::always_inline]] static inline F row(const float* m, int number, const T& v) {
    const float* r = m + kColumns * number;
    const F sum = r[0] * v.x + r[1] * v.y + r[2] * v.z;
    return kColumns == 4 ? sum + r[3] : sum;
  }

  /// The twelve numbers of a corner.
  [[gnu::always_inline]] static inline void corner(const SurfaceJob& job, const int* which, F* out) {
    F from[kVertexFloats];
    for (int first = 0; first < kVertexFloats; first += 4)
      By::columns(
          [&](int lane) { return job.vertices + kVertexFloats * static_cast<long>(which[lane]) + first; },
          from + first);
    const T place{from[0], from[1], from[2]}, normal{from[3], from[4], from[5]};
    T n{row<3>(job.normals, 0, normal), row<3>(job.normals, 1, normal), row<3>(job.normals, 2, normal)};
    n = n * L::perRoot(L::most(T::dot(n, n), L::all(1e-30f)));
    out[0] = n.x;
    out[1] = n.y;
    out[2] = n.z;
    for (int k = 0; k < 3; ++k) out[3 + k] = row<4>(job.model, k, place);
    for (int k = 6; k < 11; ++k) out[k] = from[k];
    out[11] = from[11] * job.alpha;
  }

  struct Placed {
    F x, y, depth;
  };
  [[gnu::always_inline]] static inline Placed placed(const SurfaceJob& job, const int* which, F left, F low) {
    F from[4];
    By::columns([&](int lane) { return job.placed.at + 4 * static_cast<long>(which[lane]); }, from);
    return {from[0] - left, from[1] - low, job.parallel ? L::all(1) : from[2]};
  }

  /// A corner's weight is its share of the triangle's area, times its nearness.
  [[gnu::always_inline]] static inline void weights(const SurfaceJob& job, const Batch& b, F* out) {
    const F left = L::whole(L::loadInts(b.left)), low = L::whole(L::loadInts(b.low));
    Placed at[3];
    for (int k = 0; k < 3; ++k) at[k] = placed(job, b.corner[k], left, low);
    const F area = (at[1].x - at[0].x) * (at[2].y - at[0].y) - (at[1].y - at[0].y) * (at[2].x - at[0].x);
    const F per = 1.0f / area;
    F sum{};
    for (int k = 0; k < 3; ++k) {
      const Placed &p = at[(k + 1) % 3], &q = at[(k + 2) % 3];
      const F by = at[k].depth * per;
      out[4 * k] = (p.y - q.y) * by, out[4 * k + 1] = (q.x - p.x) * by;
      out[4 * k + 2] = (p.x * q.y - p.y * q.x) * by;
      sum += out[4 * k] + out[4 * k + 1] + out[4 * k + 2];
    }
    const I serves = L::size(sum) < 3e38f;
    for (int k = 0; k < 3; ++k) {
      out[4 * k] = L::where(serves, out[4 * k]), out[4 * k + 1] = L::where(serves, out[4 * k + 1]);
      out[4 * k + 2] = L::select(serves, out[4 * k + 2], L::all(1));
    }
    out[3] = left;
    out[7] = low;
    out[11] = L::load(b.facing);
  }

  static void make(const SurfaceJob& job) {
    for (unsigned i = 0; i < job.count; i += kLanes) {
      const Batch b = batch(job, i);
      F columns[kSurfaceFloats];
      weights(job, b, columns);
      for (int k = 0; k < 3; ++k) corner(job, b.corner[k], columns + 12 * (k + 1));
      SurfaceBlock unused;
      for (int first = 0; first < kSurfaceFloats; first += 4)
        By::rows(columns + first, [&](int lane) {
          return (lane < b.count ? job.out[i + static_cast<unsigned>(lane)] : unused).at + first;
        });
    }
  }
};

}  // namespace
}  // namespace stadion
