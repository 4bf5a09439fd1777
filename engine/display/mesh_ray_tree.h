#pragma once
/// Finds the first triangle of a mesh screen that a ray meets, from either side.
///
/// Frames     as the mesh.
/// Ownership  keeps numbers of triangles only; each question names the same mesh.
/// Threads    const use from any number of threads.

#include "engine/display/screen.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace stadion {

class MeshRayTree {
public:
  MeshRayTree() = default;
  explicit MeshRayTree(const MeshScreen& mesh);

  /// Returns the place of the first hit in multiples of `direction`.
  std::optional<double> firstHit(const MeshScreen& mesh, const Vec3& origin, const Vec3& direction) const;

private:
  /// A box about triangles. A leaf has `count` of them from `first`; an inner box has count 0, its one child
  /// behind it and its other child at `first`.
  struct Box {
    Aabb bounds;
    std::uint32_t first = 0, count = 0;
  };

  void build(const MeshScreen& mesh, std::uint32_t begin, std::uint32_t end);

  std::vector<Box> boxes_;
  std::vector<std::uint32_t> order_;  ///< triangles, those of a leaf side by side
};

}  // namespace stadion
