#pragma once
/// Colours of fragments: sorted by material and triangle, so that the kernels shade neighbours together.
///
/// Threads  one at a time. Keeps its memory from band to band.

#include "pipeline/cpu_draw/band_triangles.h"
#include "pipeline/cpu_draw/picture_shading.h"

#include <vector>

namespace stadion {

/// A FragmentList with its memory.
class Fragments {
public:
  /// Empty, with room for `most` fragments of `triangles` triangles and of the sky.
  void begin(unsigned triangles, std::size_t most);
  FragmentList& list() { return list_; }
  const FragmentList& list() const { return list_; }
  void add(unsigned number, unsigned pixel, unsigned place) {
    list_.number[list_.size] = number;
    list_.pixel[list_.size] = pixel;
    list_.place[list_.size++] = place;
    ++list_.times[number];
  }

private:
  FragmentList list_{};
  std::vector<unsigned> memory_, times_;
};

class FragmentShading {
public:
  /// Writes the colours of fragments at their places. `runs`: of the pixels to the right, too.
  void shade(const PictureShading& picture, BandTriangles& triangles, const SurfaceBlocks& blocks,
             const FragmentList& fragments, bool runs, float* colours);

private:
  void findVisible(const BandTriangles& triangles, const FragmentList& fragments);
  void sort(const PictureShading& picture, const BandTriangles& triangles, const FragmentList& fragments);

  std::vector<unsigned> visible_;                  ///< triangles
  std::vector<unsigned> next_;                     ///< by triangle: where its next fragment goes
  std::vector<unsigned> ends_;                     ///< by material
  std::vector<unsigned> pixel_, surface_, place_;  ///< sorted
};

}  // namespace stadion
