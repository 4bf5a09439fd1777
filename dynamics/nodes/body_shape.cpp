#include "dynamics/nodes/body_shape.h"

#include "dynamics/nodes/dyn_object_node.h"
#include "engine/scene/scene.h"

namespace stadion {

Vec3 scaleOf(const Affine& X) {
  return X.linear().colwise().norm().transpose();
}

Mesh scaledForCollision(const Mesh& mesh, const Vec3& scale) {
  Mesh scaled;
  scaled.positions = mesh.positions;
  scaled.indices = mesh.indices;
  scaled.name = mesh.name;
  const Eigen::Vector3f s = scale.cast<float>();
  for (auto& p : scaled.positions)
    for (std::size_t i = 0; i < 3; ++i) p[i] *= s[static_cast<int>(i)];
  for (const auto& p : scaled.positions) scaled.bounds.include(Vec3(p[0], p[1], p[2]));
  scaled.sphere = {mesh.sphere.centre.cwiseProduct(scale), mesh.sphere.radius * scale.maxCoeff()};
  return scaled;
}

ShapeKind shapeKindOf(const std::string& word) {
  if (word == "sphere") return ShapeKind::Ball;
  if (word == "box") return ShapeKind::Box;
  if (word == "capsule") return ShapeKind::Capsule;
  if (word == "cylinder") return ShapeKind::Cylinder;
  if (word == "convex") return ShapeKind::Convex;
  if (word == "plane") return ShapeKind::Plane;
  if (word == "mesh") return ShapeKind::Mesh;
  return ShapeKind::Auto;
}

ColliderDef colliderOf(const ObjectNode& object, Scene& scene, World& world) {
  ColliderDef def;
  const Affine& X_WN = scene.placements().world(object.placement());
  def.pose = poseOf(X_WN);
  // A body that another dynamics node moves takes part with the shape and surface that its script gave it.
  if (const auto* body = dynamic_cast<const DynObjectNode*>(&object)) def.surface = body->body().surface;
  def.shape = addShapeOf(object, scene, world);
  return def;
}

Result<ShapeChoice> shapeOf(const ObjectNode& object, Scene& scene) {
  const Mesh* mesh = scene.mesh(object.appearance().mesh);
  if (!mesh) return Result<ShapeChoice>::failure("has no model to collide with");
  return chooseShape(scaledForCollision(*mesh, scaleOf(scene.placements().world(object.placement()))),
                     shapeKindOf(object.appearance().shape), object.appearance().tolerance);
}

ShapeId addShapeOf(const ObjectNode& object, Scene& scene, World& world) {
  auto chosen = shapeOf(object, scene);
  return chosen ? world.addShape(std::move(chosen.value().shape)) : 0;
}

}  // namespace stadion
