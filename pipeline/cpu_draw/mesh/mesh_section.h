#pragma once
/// A run of triangles of a mesh that a picture leaves out as a whole if it cannot see any of them.
///
/// Threads  a plain value and a pure function.

#include "pipeline/cpu_draw/kernels/kernel_data.h"

#include <array>
#include <cstdint>

namespace stadion {

struct MeshSection {
  std::uint32_t firstTriangle = 0, triangles = 0;
  std::uint32_t firstVertex = 0, endVertex = 0;  ///< its corners are among these
  std::array<float, 3> low{}, high{};            ///< box around its corners, in mesh coordinates
};

/// Returns true if the section's box may reach into a picture of `width` by `height` pixels. False only if
/// each triangle of it lies beside the picture or behind the eye, by more than rounding.
bool mayBeSeen(const MeshSection& section, const PixelMatrix& by, bool parallel, int width, int height);

}  // namespace stadion
