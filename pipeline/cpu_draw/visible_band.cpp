#include "pipeline/cpu_draw/visible_band.h"

namespace stadion {

void VisibleBand::draw(const PictureShading& picture, std::size_t band, const SurfaceBlocks& blocks) {
  const DrawKernels& kernels = *picture.kernels;
  const PictureSetup& setup = *picture.setup;
  const int samples = picture.rung.samples;
  stride_ = picture.stride(), low_ = picture.low(band), end_ = picture.end(band);
  const auto size = static_cast<std::size_t>(stride_) * static_cast<std::size_t>(end_ - low_);
  depths_.assign(size, setup.geometry().farDepth), seen_.assign(size, kNoTriangle);
  triangles_.clear();
  setup.forEach(Transparency::Opaque, band,
                [&](const TriangleRecord& record, const TriangleStretch& stretch) {
                  const unsigned number = triangles_.add(record, stretch);
                  const int* present = nullptr;
                  if (stretch.part->masked) {
                    const unsigned block = triangles_.block(number, blocks);
                    present = cutouts_.present(kernels, record, triangles_.blocks()[block],
                                               *setup.materials()[stretch.material],
                                               picture.rung.nearestLevel, {low_, end_, stride_, samples});
                  }
                  kernels.cover(record, number, samples, present, this->samples());
                });
}

}  // namespace stadion
