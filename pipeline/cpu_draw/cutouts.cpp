#include "pipeline/cpu_draw/cutouts.h"

#include <algorithm>

namespace stadion {

const int* Cutouts::present(const DrawKernels& kernels, const TriangleRecord& record,
                            const SurfaceBlock& surface, const MaterialParameters& material,
                            bool nearestLevel, const CutoutBand& band) {
  present_.resize(std::max(present_.size(), static_cast<std::size_t>(band.stride * (band.end - band.low))));
  pixels_.clear(), order_.clear();
  const int low = std::max<int>(record.low, band.low), end = std::min<int>(record.high + 1, band.end);
  for (int y = low; y < end; ++y)
    for (int x = record.left; x <= record.right; ++x) {
      order_.push_back(static_cast<unsigned>(pixels_.size()));
      pixels_.push_back(static_cast<unsigned>(x) | static_cast<unsigned>(y) << 16);
    }
  if (pixels_.empty()) return present_.data();
  surfaces_.assign(pixels_.size(), 0), found_.resize(pixels_.size());
  FragmentJob job{};
  job.surfaces = &surface, job.order = order_.data(), job.count = static_cast<unsigned>(order_.size());
  job.pixel = pixels_.data(), job.surface = surfaces_.data(), job.material = &material;
  job.nearestLevel = nearestLevel;
  kernels.cutOut(job, found_.data());
  const int* found = found_.data();
  for (int y = low; y < end; ++y)
    for (int x = record.left; x <= record.right; ++x, ++found)
      std::fill_n(present_.begin() + (y - band.low) * band.stride + x * band.samples, band.samples, *found);
  return present_.data();
}

}  // namespace stadion
