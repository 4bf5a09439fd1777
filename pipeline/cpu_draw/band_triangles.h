#pragma once
/// Triangles of a band, and the surface blocks of those that are visible.
///
/// Numbers  of triangles: in the order of the list, from 0 on.
/// Threads  one at a time. Keeps its memory from band to band.

#include "pipeline/cpu_draw/surface_blocks.h"

#include <span>
#include <vector>

namespace stadion {

class BandTriangles {
public:
  /// Triangles that follow each other.
  struct Run {
    unsigned first, count;
    bool masked;  ///< their materials leave holes
  };

  void collect(const PictureSetup& setup, Transparency which, std::size_t band);

  std::span<const Run> runs() const { return runs_; }
  unsigned size() const { return static_cast<unsigned>(records_.size()); }
  const TriangleRecord& record(unsigned number) const { return *records_[number]; }
  const TriangleRecord* const* records() const { return records_.data(); }

  /// Makes the surface blocks of triangles that have none yet.
  void makeBlocks(const SurfaceBlocks& from, std::span<const unsigned> numbers);
  /// Expects a triangle whose block was made.
  unsigned block(unsigned number) const { return blockOf_[number]; }
  const SurfaceBlock* blocks() const { return blocks_.data(); }
  /// As many; null: no mesh has any.
  const SurfaceExtra* extras() const { return extras_.empty() ? nullptr : extras_.data(); }

private:
  std::vector<Run> runs_;
  std::vector<const TriangleRecord*> records_, without_;
  std::vector<unsigned> blockOf_;
  std::vector<SurfaceBlock> blocks_;  ///< more than are used: it keeps its memory
  std::vector<SurfaceExtra> extras_;
  unsigned blocksUsed_ = 0;
};

}  // namespace stadion
