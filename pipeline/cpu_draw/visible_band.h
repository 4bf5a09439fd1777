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

  BandTriangles& triangles() { return triangles_; }
  Cutouts& cutouts() { return cutouts_; }
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
