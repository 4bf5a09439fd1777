#pragma once
/// Places the vertices of a mesh as its joints carry them (linear blend skinning).
///
/// Formula  p' = sum of w · J p over a vertex's joints; normals by the cofactors of the same blended matrix,
///          which is right for every scale, and brought to unit length; tangents by the matrix itself.
/// Accuracy single precision, of matrices that were computed in double; the same on every processor, because
///          nothing is fused or approximated.
/// Threads  pure.

#include "engine/figure/figure_pose.h"

#include <array>
#include <span>

namespace stadion {

struct SkinnedVertex {
  std::array<float, 3> position, normal;
};

/// What a figure's mesh gives: as many of each.
struct SkinSource {
  std::span<const std::array<float, 3>> positions, normals;
  std::span<const VertexJoints> joints;
};

/// Fills `out` with the vertices from `first` on. Expects joints that the palette has.
void skin(const SkinSource& from, std::span<const JointMatrix> palette, std::size_t first,
          std::span<SkinnedVertex> out);
/// Likewise, of tangents (Mesh::tangents).
void skinTangents(std::span<const std::array<float, 4>> tangents, std::span<const VertexJoints> joints,
                  std::span<const JointMatrix> palette, std::size_t first,
                  std::span<std::array<float, 4>> out);

}  // namespace stadion
