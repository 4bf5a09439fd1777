#pragma once
/// Tests and distances of meshes by hierarchies of boxes, made by FCL. Its types stay in mesh_distance.cpp.
///
/// Errors   an exception or a senseless answer from the library gives "unknown", which the callers treat as
///          "do not move on".

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
  /// Returns true if a triangle of one crosses one of the other. Tests boxes along the axes of the meshes,
  /// then triangles; knows no inside. True if the library fails.
  static bool cross(const MeshHierarchy& a, const Pose& X_WA, const MeshHierarchy& b, const Pose& X_WB);
  /// Returns true if a ball at `centre` reaches a triangle. In the mesh's coordinates.
  bool reaches(const Vec3& centre, double radius) const;

private:
  struct Model;
  std::unique_ptr<Model> model_;
};

}  // namespace stadion
