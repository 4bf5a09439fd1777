#pragma once
/// Nodes of this layer with shapes given by the test, for shows built by hand.

#include "dynamics/collision/shape_choice.h"
#include "dynamics/nodes/collision_node.h"
#include "dynamics/nodes/dynamics_node.h"
#include "engine/nodes/object_node.h"
#include "tests/engine/scene/show_fixture.h"

namespace stadion::show_nodes {

constexpr double kStandardGravity = 9.80665;  ///< m/s^2, a field's own where its script says nothing

class Field : public FieldNode {
public:
  Field(NodeRef self, std::string name, const Vec3& push, bool on, double duration = 0,
        PlaceAttributes place = {}, std::optional<StrengthAxis> axis = {})
      : FieldNode(kForceLinearType, self, std::move(name), std::move(place),
                  {LinearField{push}, fromSeconds(duration), on, std::move(axis)}) {}
};

/// An object with a ball for a mesh would need a mesh; here the body's shape is given.
class Ball : public DynObjectNode {
public:
  Ball(NodeRef self, std::string name, const Vec3& p, std::vector<std::string> hooks, NodeRef parent = {},
       MeshId mesh = kNoMesh)
      : DynObjectNode(self, std::move(name), at(p, parent), {mesh, true, "box"}, body(std::move(hooks)),
                      fit()) {}

private:
  static PlaceAttributes at(const Vec3& p, NodeRef parent) {
    PlaceAttributes place;
    place.parent = parent;
    place.X_PN.translation() = p;
    return place;
  }
  static BodyAttributes body(std::vector<std::string> hooks) {
    BodyAttributes b;
    b.density = 500;
    b.hooks = std::move(hooks);
    return b;
  }
  static SharedFit fit() {
    ShapeChoice ball;
    ball.shape = BallShape{Vec3::Zero(), 0.1}, ball.kind = ShapeKind::Ball;
    return std::make_shared<const FittedShape>(
        FittedShape{Vec3::Ones(), std::move(ball), massOfSphere(Vec3::Zero(), 0.1, 1), 0});
  }
};

class Sim : public DynamicsNode {
public:
  Sim(NodeRef self, std::string name, std::vector<std::string> colliders, std::vector<std::string> collidees)
      : DynamicsNode(self, std::move(name), {std::move(colliders), std::move(collidees), 0.5, true, true, {}},
                     std::make_shared<ShapeStore>()) {}
};

class TouchWatch : public CollisionNode {
public:
  TouchWatch(NodeRef self, std::string name, std::vector<std::string> colliders,
             std::vector<std::string> collidees)
      : CollisionNode(kCollisionType, self, std::move(name),
                      {std::move(colliders), std::move(collidees), 0.5, true, true, {}},
                      std::make_shared<ShapeStore>()) {}
};

/// A unit cube, as meshes come: 12 triangles facing outwards.
inline std::unique_ptr<Mesh> cube(double half) {
  auto mesh = std::make_unique<Mesh>();
  const auto h = static_cast<float>(half);
  for (int i = 0; i < 8; ++i) mesh->positions.push_back({i & 1 ? h : -h, i & 2 ? h : -h, i & 4 ? h : -h});
  mesh->indices = {0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4,
                   2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5};
  mesh->normals.assign(8, {0, 0, 1});
  mesh->materials.emplace_back();
  for (const auto& p : mesh->positions) mesh->bounds.include(Vec3(p[0], p[1], p[2]));
  mesh->sphere = {Vec3::Zero(), half * 1.7320509};
  mesh->hash = std::bit_cast<std::uint64_t>(half);
  return mesh;
}

class Block : public ObjectNode {
public:
  Block(NodeRef self, std::string name, MeshId mesh, const Vec3& p)
      : ObjectNode(kObjectType, self, std::move(name), at(p), {mesh, true, "box"}) {}

private:
  static PlaceAttributes at(const Vec3& p) {
    PlaceAttributes place;
    place.X_PN.translation() = p;
    return place;
  }
};

}  // namespace stadion::show_nodes
