#include "pipeline/cpu_draw/cutouts.h"

#include <algorithm>

namespace stadion {

/// In the pixels of the triangle's box between two rows.
void Cutouts::find(const DrawKernels& kernels, const TriangleRecord& record, FragmentJob& job, int low,
                   int end) {
  pixels_.clear();
  for (int y = low; y < end; ++y)
    for (int x = record.left; x <= record.right; ++x)
      pixels_.push_back(static_cast<unsigned>(x) | static_cast<unsigned>(y) << 16);
  job.count = static_cast<unsigned>(pixels_.size());
  const std::size_t padded = pixels_.size() + kKernelPadding;
  pixels_.resize(padded);
  surfaces_.assign(padded, 0);
  found_.resize(padded);
  job.pixel = pixels_.data();
  job.surface = surfaces_.data();
  job.place = surfaces_.data();
  kernels.cutOut(job, found_.data());
}

const int* Cutouts::present(const DrawKernels& kernels, const PictureSetup& setup, BandTriangles& list,
                            unsigned number, const SurfaceBlocks& blocks, bool nearestLevel,
                            const CutoutBand& band) {
  const TriangleRecord& record = list.record(number);
  list.makeBlocks(blocks, {&number, 1});
  FragmentJob job{};
  job.surfaces = list.blocks() + list.block(number);
  if (list.extras()) job.extras = list.extras() + list.block(number);
  job.material = setup.materials()[setup.stretchOf(record).material];
  job.nearestLevel = nearestLevel;
  const int low = std::max<int>(record.low, band.low), end = std::min<int>(record.high + 1, band.end);
  find(kernels, record, job, low, end);
  present_.resize(std::max(present_.size(), static_cast<std::size_t>(band.stride * (band.end - band.low))));
  const int* found = found_.data();
  for (int y = low; y < end; ++y)
    for (int x = record.left; x <= record.right; ++x, ++found)
      std::fill_n(present_.begin() + (y - band.low) * band.stride + x * band.samples, band.samples, *found);
  return present_.data();
}

}  // namespace stadion
