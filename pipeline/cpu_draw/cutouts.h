#pragma once
/// Holes that the alpha of a material leaves in a triangle.
///
/// Threads  one at a time. Keeps its memory from band to band.

#include "pipeline/cpu_draw/band_triangles.h"
#include "pipeline/cpu_draw/kernels/kernel_data.h"

#include <vector>

namespace stadion {

/// The band in which a triangle is drawn.
struct CutoutBand {
  int low, end;  ///< rows
  int stride;    ///< samples a row
  int samples;   ///< for each pixel
};

class Cutouts {
public:
  /// For each sample of the band in the box of a triangle of the list: -1 if it is there, else 0. A pixel is
  /// there or not as a whole, as its middle is.
  const int* present(const DrawKernels& kernels, const PictureSetup& setup, BandTriangles& list,
                     unsigned number, const SurfaceBlocks& blocks, bool nearestLevel, const CutoutBand& band);

private:
  void find(const DrawKernels& kernels, const TriangleRecord& record, FragmentJob& job, int low, int end);

  std::vector<unsigned> pixels_, surfaces_;
  std::vector<int> found_, present_;
};

}  // namespace stadion
