#pragma once
/// From models to what the world collides: each fitted once for all the objects that look alike.

#include "dynamics/collision/shape_choice.h"
#include "dynamics/shapes/mass_properties.h"
#include "dynamics/shapes/shape.h"
#include "engine/maths/pose_track.h"
#include "engine/scene/object_node.h"

#include <map>
#include <memory>
#include <mutex>
#include <tuple>

namespace stadion {

/// A model's shape and what follows from it, in the coordinates of its objects: scaled, not placed.
struct FittedShape {
  Vec3 scale = Vec3::Ones();      ///< in single precision, as the model
  ShapeChoice choice;             ///< the shape, with a remark on how near it is to the model
  Result<MassProperties> filled;  ///< with 1 kg/m3; the reason why not, of an open model
  /// Drag coefficient times cross section [m2]: of a ball by its shape; of others the mean cross section, a
  /// quarter of a convex surface (Cauchy), with a coefficient of 1.
  double dragArea = 0;
};
using SharedFit = std::shared_ptr<const FittedShape>;

/// Ownership  all users of a fit own it together; it is deleted with the last of them.
/// Threads    any: the loader fits what a file declares before App needs it.
/// The mesh's form at another size, without what it looks like.
Mesh scaled(const Mesh& mesh, const Eigen::Vector3f& scale);

class ShapeStore {
public:
  /// How `mesh` collides as an object that looks like `appearance`. Fails if it has no usable triangle.
  Result<SharedFit> fit(const Mesh& mesh, const Appearance& appearance, const Vec3& scale);

private:
  using Key = std::tuple<MeshId, float, float, float, std::string, double>;

  std::mutex mutex_;
  std::map<Key, std::weak_ptr<const FittedShape>> known_;
  std::size_t pruneAt_ = 64;
};

}  // namespace stadion
