#pragma once
/// Fragments that are shaded at a time, one in each lane.
///
/// Linkage  internal.

#include "pipeline/cpu_draw/kernels/kernel_data.h"
#include "pipeline/cpu_draw/kernels/lanes.h"

namespace stadion {
namespace {

template <class By>
struct FragmentBatch : DrawLanes<By> {
  using L = DrawLanes<By>;
  using F = typename L::F;
  using I = typename L::I;
  static constexpr int kLanes = By::kLanes;

  F x, y;  ///< middles of the pixels
  const unsigned *surface, *place;
  int shift;       ///< lane >> shift is the lane's index in `surface` and `place`
  int within;      ///< of a run's pixels, the first lane has this one
  unsigned count;  ///< lanes from here on have any fragments
  bool uniform;    ///< all on one triangle

  /// The index of a lane's surface among those of its job.
  [[gnu::always_inline]] inline unsigned surfaceOf(int lane) const { return surface[lane >> shift]; }

  /// Single fragments of a job.
  [[gnu::always_inline]] static inline FragmentBatch ones(const FragmentJob& job, unsigned first) {
    FragmentBatch b;
    b.surface = job.surface + first;
    b.place = job.place + first;
    b.shift = b.within = 0;
    b.count = job.count - first < kLanes ? job.count - first : kLanes;
    const I pixel = L::loadInts(job.pixel + first), surface = L::loadInts(b.surface);
    b.x = L::whole(pixel & 0xffff) + 0.5f;
    b.y = L::whole((pixel >> 16) & 0xffff) + 0.5f;
    const I differs = surface != I{} + static_cast<int>(b.surface[0]);
    b.uniform = (L::bits(differs) & (L::kAll >> (kLanes - b.count))) == 0;
    return b;
  }
  /// Pixels of a job's runs, counted from its first run.
  [[gnu::always_inline]] static inline FragmentBatch runs(const FragmentJob& job, unsigned first) {
    FragmentBatch b;
    const unsigned run = first / kRunPixels, left = kRunPixels * job.count - first;
    b.surface = job.surface + run;
    b.place = job.place + run;
    b.shift = kRunShift;
    b.within = static_cast<int>(first % kRunPixels);
    b.count = left < kLanes ? left : kLanes;
    b.uniform = kLanes <= kRunPixels || b.count < kLanes || b.surface[0] == b.surface[1];
    const I offset = (L::lanes() & (kRunPixels - 1)) + b.within;
    const I pixel = perRun(job.pixel + run);
    b.x = L::whole((pixel & 0xffff) + offset) + 0.5f;
    b.y = L::whole((pixel >> 16) & 0xffff) + 0.5f;
    return b;
  }

  /// A number of each lane's run.
  [[gnu::always_inline]] static inline I perRun(const unsigned* of) {
    I out = I{} + static_cast<int>(of[0]);
    if constexpr (kLanes > kRunPixels)
      out = By::select(L::lanes() < kRunPixels, out, I{} + static_cast<int>(of[1]));
    return out;
  }

  /// Red, green, blue and alpha.
  struct Colour {
    F column[4];
  };
  [[gnu::always_inline]] inline void put(const FragmentJob& job, const Colour& c) const {
    const auto to = [&](int lane) {
      const int pixel = within + (lane & ((1 << shift) - 1));
      return job.colours + 4 * (static_cast<long>(place[lane >> shift]) + pixel);
    };
    if (count == kLanes) return By::rows(c.column, to);
    alignas(64) float colours[4 * kLanes];
    By::rows(c.column, [&](int lane) { return colours + 4 * lane; });
    for (int lane = 0; lane < static_cast<int>(count); ++lane)
      __builtin_memcpy(to(lane), colours + 4 * lane, 4 * sizeof(float));
  }
  /// Calls shader(batch) for all fragments and keeps the colours that it returns.
  template <class Shader>
  [[gnu::always_inline]] static inline void shadeAll(const FragmentJob& job, const Shader& shader) {
    if (job.runs != 0) {
      for (unsigned i = 0; i < kRunPixels * job.count; i += kLanes) {
        const FragmentBatch b = runs(job, i);
        b.put(job, shader(b));
      }
    } else {
      for (unsigned i = 0; i < job.count; i += kLanes) {
        const FragmentBatch b = ones(job, i);
        b.put(job, shader(b));
      }
    }
  }

private:
  static constexpr int kRunShift = 3;
  static_assert(1 << kRunShift == kRunPixels && kLanes <= 2 * kRunPixels);
};

}  // namespace
}  // namespace stadion
