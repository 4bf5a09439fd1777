#pragma once
/// Which opaque triangle each sample of a band shows, and how near it is.
///
/// Threads  one at a time. Keeps its memory from band to band.

#include "pipeline/cpu_draw/band_triangles.h"
#include "pipeline/cpu_draw/cutouts.h"
#include "pipeline/cpu_draw/picture_shading.h"

#include <span>
#include <vector>

namespace stadion {

class VisibleBand {
public:
  void draw(const PictureShading& picture, std::size_t band, const SurfaceBlocks& blocks);
  /// Calls work(first, count, present) for triangles of a list of this band that follow each other: those
  /// that have no holes (present is null) or one that has.
  template <class Work>
  void forRuns(const PictureShading& picture, BandTriangles& list, const SurfaceBlocks& blocks,
               const Work& work) {
    for (const BandTriangles::Run& run : list.runs()) {
      if (!run.masked) work(run.first, run.count, nullptr);
      for (unsigned i = run.first; run.masked && i < run.first + run.count; ++i)
        work(i, 1u,
             cutouts_.present(*picture.kernels, *picture.setup, list, i, blocks, picture.rung.nearestLevel,
                              {low_, end_, stride_, picture.rung.samples}));
    }
  }

  BandTriangles& triangles() { return triangles_; }
  const BandTriangles& triangles() const { return triangles_; }
  /// Numbers of triangles, or kNoTriangle: the samples of a row's pixels.
  const unsigned* row(int y) const { return seen_.data() + static_cast<std::ptrdiff_t>(y - low_) * stride_; }
  /// For kernels that compare depths with it.
  BandSamples samples() { return {depths_.data(), seen_.data(), stride_, low_, end_}; }
  int low() const { return low_; }
  int end() const { return end_; }

private:
  BandTriangles triangles_;
  Cutouts cutouts_;
  std::vector<float> depths_;
  std::vector<unsigned> seen_;
  int stride_ = 0, low_ = 0, end_ = 0;
};

}  // namespace stadion
