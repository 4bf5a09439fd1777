#pragma once
/// From scene objects to what the world collides: shapes, poses, surfaces.

#include "dynamics/world.h"
#include "engine/maths/course.h"
#include "engine/nodes/object_node.h"

namespace stadion {

class Scene;

/// The lengths of a placement's axes.
Vec3 scaleOf(const Affine& X);

/// The mesh in a body's own coordinates: scaled, not placed.
Mesh scaledForCollision(const Mesh& mesh, const Vec3& scale);

/// The kind of shape that a script's word asks for; empty = auto.
ShapeKind shapeKindOf(const std::string& word);

/// The object's shape as its script asks for it, with a remark on how near it is to the model.
Result<ShapeChoice> shapeOf(const ObjectNode& object, Scene& scene);

/// The same, added to `world`. 0 if its mesh has no usable triangle.
ShapeId addShapeOf(const ObjectNode& object, Scene& scene, World& world);

/// A collider for an object, its shape added to `world`. Shape 0 if its mesh has no usable triangle.
ColliderDef colliderOf(const ObjectNode& object, Scene& scene, World& world);

}  // namespace stadion
