#pragma once
/// The nearest pair of triangles of two meshes, found by FCL. Its types stay in mesh_distance.cpp.
///
/// Errors   an exception or a senseless answer from the library gives "unknown", which the callers treat as
/// "do not move on".

#include "engine/maths/maths.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace stadion {

struct Triangle;

/// A hierarchy of oriented boxes and swept spheres over a mesh.
class MeshHierarchy {
public:
  explicit MeshHierarchy(const std::vector<Triangle>& triangles);
  ~MeshHierarchy();
  MeshHierarchy(MeshHierarchy&&) noexcept;
  MeshHierarchy& operator=(MeshHierarchy&&) noexcept;

  struct Pair {
    std::uint32_t a, b;  ///< triangles
    bool crossing;       ///< the meshes overlap there
  };
  /// The nearest triangles, or some that cross.
  static std::optional<Pair> nearest(const MeshHierarchy& a, const Pose& X_WA, const MeshHierarchy& b,
                                     const Pose& X_WB);

private:
  struct Model;
  std::unique_ptr<Model> model_;
};

}  // namespace stadion
