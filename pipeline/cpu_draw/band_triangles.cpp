#include "pipeline/cpu_draw/band_triangles.h"

namespace stadion {

void BandTriangles::collect(const PictureSetup& setup, Transparency which, std::size_t band) {
  runs_.clear();
  records_.clear();
  blocksUsed_ = 0;
  setup.forEach(which, band,
                [this](const TriangleRecord* records, std::span<const std::uint32_t> numbers, bool masked) {
                  const unsigned first = size();
                  records_.resize(first + numbers.size());
                  for (std::size_t i = 0; i < numbers.size(); ++i) records_[first + i] = records + numbers[i];
                  runs_.push_back({first, static_cast<unsigned>(numbers.size()), masked});
                });
  blockOf_.assign(records_.size(), kNoTriangle);
}

void BandTriangles::makeBlocks(const SurfaceBlocks& from, std::span<const unsigned> numbers) {
  without_.clear();
  for (const unsigned number : numbers)
    if (blockOf_[number] == kNoTriangle) {
      blockOf_[number] = blocksUsed_ + static_cast<unsigned>(without_.size());
      without_.push_back(records_[number]);
    }
  const std::size_t used = blocksUsed_ + without_.size();
  if (blocks_.size() < used + 1) blocks_.resize(2 * used + 1);
  from.fill(without_, blocks_.data() + blocksUsed_);
  if (from.hasExtras()) {
    if (extras_.size() < blocks_.size()) extras_.resize(blocks_.size());
    from.fillExtras(without_, extras_.data() + blocksUsed_);
  }
  blocksUsed_ = static_cast<unsigned>(used);
}

}  // namespace stadion
