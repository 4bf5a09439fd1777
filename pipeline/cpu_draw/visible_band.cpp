#include "pipeline/cpu_draw/visible_band.h"

namespace stadion {

void VisibleBand::draw(const PictureShading& picture, std::size_t band, const SurfaceBlocks& blocks) {
  const DrawKernels& kernels = *picture.kernels;
  const PictureSetup& setup = *picture.setup;
  const int samples = picture.rung.samples;
  stride_ = picture.stride();
  low_ = picture.low(band);
  end_ = picture.end(band);
  const auto size = static_cast<std::size_t>(stride_) * static_cast<std::size_t>(end_ - low_);
  depths_.assign(size, setup.geometry().farDepth);
  seen_.assign(size, kNoTriangle);
  triangles_.collect(setup, Transparency::Opaque, band);
  forRuns(picture, triangles_, blocks, [&](unsigned first, unsigned count, const int* present) {
    kernels.cover(triangles_.records() + first, count, first, samples, present, this->samples());
  });
}

}  // namespace stadion
