#pragma once
/// Triangles of a band, and the surface blocks of those that are visible.
///
/// Threads  one at a time. Keeps its memory from band to band.

#include "pipeline/cpu_draw/surface_blocks.h"

#include <vector>

namespace stadion {

class BandTriangles {
public:
  void clear() { records_.clear(), stretches_.clear(), blockOf_.clear(), blocks_.clear(); }

  /// Returns the triangle's number.
  unsigned add(const TriangleRecord& record, const TriangleStretch& stretch) {
    records_.push_back(record), stretches_.push_back(&stretch), blockOf_.push_back(kNoTriangle);
    return static_cast<unsigned>(records_.size() - 1);
  }
  const TriangleRecord& record(unsigned number) const { return records_[number]; }
  const TriangleStretch& stretch(unsigned number) const { return *stretches_[number]; }

  /// Returns the number of a triangle's surface block, which is made at its first use.
  unsigned block(unsigned number, const SurfaceBlocks& from) {
    unsigned& block = blockOf_[number];
    if (block == kNoTriangle) {
      block = static_cast<unsigned>(blocks_.size());
      from.fill(records_[number], *stretches_[number], blocks_.emplace_back());
    }
    return block;
  }
  const SurfaceBlock* blocks() const { return blocks_.data(); }

private:
  std::vector<TriangleRecord> records_;
  std::vector<const TriangleStretch*> stretches_;
  std::vector<unsigned> blockOf_;
  std::vector<SurfaceBlock> blocks_;
};

}  // namespace stadion
