#pragma once
/// What a body or collider looks like to the collision tests: the simplest form that serves.
///
/// Frames   in the node's coordinates N; metres.
/// Threads  immutable once built.

#include "dynamics/shapes/convex_hull.h"
#include "dynamics/shapes/mesh_distance.h"
#include "dynamics/shapes/triangle_tree.h"
#include "engine/asset/mesh.h"
#include "engine/base/diagnostic.h"
#include "engine/maths/maths.h"

#include <memory>
#include <string>
#include <utility>
#include <variant>

namespace stadion {

struct BallShape {
  Vec3 centre = Vec3::Zero();
  double radius = 0.5;
};

struct BoxShape {
  Pose pose;  ///< box axes and centre in N
  Vec3 half = Vec3::Constant(0.5);
};

/// A one-sided half space below z = 0 of `pose`. With finite `half`, a rectangular sheet that bodies roll
/// off.
struct PlaneShape {
  Pose pose;
  Vec2 half = Vec2::Constant(1e300);  ///< extents along the pose's x and y [m]
  Vec3 normal() const { return pose.q * Vec3::UnitZ(); }
  bool bounded() const { return half.x() < 1e299; }
};

/// Everything within `radius` of a segment along z of `pose`.
struct CapsuleShape {
  Pose pose;
  double radius = 0.5;
  double half = 0.5;  ///< half length of the segment [m]
};

/// A round rod or disc about z of `pose`.
struct CylinderShape {
  Pose pose;
  double radius = 0.5;
  double half = 0.5;  ///< half height [m]
};

struct MeshShape {
  explicit MeshShape(TriangleTree t)
      : tree(std::move(t)), hierarchy(std::make_unique<MeshHierarchy>(tree.triangles())) {}
  TriangleTree tree;                         ///< for balls, corners and rays
  std::unique_ptr<MeshHierarchy> hierarchy;  ///< for other meshes
};

/// The convex ones go through convex_core.h; balls, unbounded planes and meshes have ways of their own as
/// well.
using Shape =
    std::variant<BallShape, BoxShape, CapsuleShape, CylinderShape, ConvexShape, PlaneShape, MeshShape>;

enum class ShapeKind { Auto, Ball, Box, Capsule, Cylinder, Convex, Plane, Mesh };

/// Everything of the shape is inside this ball. Infinite radius for an unbounded plane.
Sphere boundingSphere(const Shape& shape);
/// Everything of the shape at X is inside this box, for sheets also what has sunk below them.
Aabb boundingBox(const Shape& shape, const Pose& X);
const char* nameOf(ShapeKind kind);

}  // namespace stadion
