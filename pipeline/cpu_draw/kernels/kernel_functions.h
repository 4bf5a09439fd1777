#pragma once
/// The kernels for a number of lanes.
///
/// Linkage  internal.

#include "pipeline/cpu_draw/kernels/coverage.h"
#include "pipeline/cpu_draw/kernels/surface_shading.h"
#include "pipeline/cpu_draw/kernels/triangle_setup.h"

namespace stadion {
namespace {

template <class By>
struct KernelFunctions {
  static void place(const MeshPositions& from, unsigned count, const PixelMatrix& by, bool parallel,
                    const PlacedVertices& to) {
    parallel ? TriangleSetup<By>::place(from, count, by, true, to)
             : TriangleSetup<By>::place(from, count, by, false, to);
  }
  static unsigned setUp(const TriangleCorners& corners, unsigned first, unsigned count,
                        const PlacedVertices& at, const SetupParameters& by, TriangleRecord* out) {
    return TriangleSetup<By>::setUp(corners, first, count, at, by, out);
  }
  static void cover(const TriangleRecord& t, unsigned number, int samples, const int* present,
                    const BandSamples& band) {
    if (samples == 1)
      Coverage<By, 1>::cover(t, number, present, band);
    else if (samples == 4)
      Coverage<By, 4>::cover(t, number, present, band);
    else
      Coverage<By, 8>::cover(t, number, present, band);
  }
  static void coverDepth(const TriangleRecord& t, const int* present, const BandSamples& band) {
    const BandSamples depths{band.depth, nullptr, band.stride, band.low, band.end};
    Coverage<By, 1>::cover(t, 0, present, depths);
  }
  static unsigned coverLayer(const TriangleRecord& t, unsigned number, int samples, const int* present,
                             const BandSamples& band, LayerFragment* out) {
    if (samples == 1) return Coverage<By, 1>::coverLayer(t, number, present, band, out);
    if (samples == 4) return Coverage<By, 4>::coverLayer(t, number, present, band, out);
    return Coverage<By, 8>::coverLayer(t, number, present, band, out);
  }
  static constexpr DrawKernels named(const char* name) {
    using Shading = SurfaceShading<By>;
    return {name,
            place,
            setUp,
            cover,
            coverDepth,
            coverLayer,
            Shading::cutOut,
            Shading::shade,
            Shading::shadePlain,
            Shading::sky,
            Shading::skyPlain};
  }
};

}  // namespace
}  // namespace stadion
