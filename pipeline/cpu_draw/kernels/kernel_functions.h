#pragma once
/// The kernels for a number of lanes.
///
/// Linkage  internal.

#include "pipeline/cpu_draw/kernels/colour_encoding.h"
#include "pipeline/cpu_draw/kernels/coverage.h"
#include "pipeline/cpu_draw/kernels/fragment_search.h"
#include "pipeline/cpu_draw/kernels/surface_making.h"
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
  static void cover(const TriangleRecord* const* triangles, unsigned count, unsigned first, int samples,
                    const int* present, const BandSamples& band) {
    if (samples == 1)
      Coverage<By, 1>::template cover<false>(triangles, count, first, present, band);
    else if (samples == 2)
      Coverage<By, 2>::template cover<false>(triangles, count, first, present, band);
    else if (samples == 4)
      Coverage<By, 4>::template cover<false>(triangles, count, first, present, band);
    else
      Coverage<By, 8>::template cover<false>(triangles, count, first, present, band);
  }
  static void coverDepth(const TriangleRecord* const* triangles, unsigned count, const int* present,
                         const BandSamples& band) {
    Coverage<By, 1>::template cover<true>(triangles, count, 0, present, band);
  }
  static unsigned coverLayer(const TriangleRecord& t, unsigned number, int samples, const int* present,
                             const BandSamples& band, LayerFragment* out) {
    if (samples == 1) return Coverage<By, 1>::coverLayer(t, number, present, band, out);
    if (samples == 2) return Coverage<By, 2>::coverLayer(t, number, present, band, out);
    if (samples == 4) return Coverage<By, 4>::coverLayer(t, number, present, band, out);
    return Coverage<By, 8>::coverLayer(t, number, present, band, out);
  }
  static void findFragments(FragmentSearch& row) {
    if (row.samples == 1) return FragmentFinder<By, 1>::find(row);
    if (row.samples == 2) return FragmentFinder<By, 2>::find(row);
    if (row.samples == 4) return FragmentFinder<By, 4>::find(row);
    FragmentFinder<By, 8>::find(row);
  }
  static constexpr DrawKernels named(const char* name) {
    using Shading = SurfaceShading<By>;
    return {name,
            place,
            setUp,
            cover,
            coverDepth,
            coverLayer,
            findFragments,
            SurfaceMaking<By>::make,
            Shading::cutOut,
            Shading::shade,
            Shading::shadePlain,
            Shading::sky,
            Shading::skyPlain,
            ColourEncoding<By>::encode};
  }
};

}  // namespace
}  // namespace stadion
