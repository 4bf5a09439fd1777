#include "dynamics/nodes/shape_store.h"

#include "tests/dynamics/nodes/show_nodes.h"

#include <gtest/gtest.h>

namespace stadion {
namespace {

using namespace show_nodes;

TEST(ShapeStore, FitsOnceForAllThatLookAlikeAndForgetsUnusedShapes) {
  ShapeStore store;
  const auto mesh = cube(0.5);
  const Appearance look{1, true, "mesh"};
  SharedFit a = store.fit(*mesh, look, Vec3::Ones()).value();
  EXPECT_EQ(store.fit(*mesh, look, Vec3::Constant(1 + 1e-12)).value(), a) << "a rotation's rounding";
  EXPECT_NE(store.fit(*mesh, {1, true, "box"}, Vec3::Ones()).value(), a);
  EXPECT_NE(store.fit(*mesh, {2, true, "mesh"}, Vec3::Ones()).value(), a);
  const SharedFit twice = store.fit(*mesh, look, Vec3::Constant(2)).value();
  EXPECT_NEAR(a->filled.value().mass, 1, 1e-12);
  EXPECT_NEAR(twice->filled.value().mass, 8, 1e-12);
  const std::weak_ptr<const FittedShape> forgotten = a;
  a = nullptr;
  EXPECT_TRUE(forgotten.expired());
  EXPECT_FALSE(store.fit(Mesh{}, look, Vec3::Constant(3)));
}

TEST(DynamicsNode, ABodyCollidesAtTheSizeThatItsParentGivesIt) {
  ShowFixture show;
  const MeshId mesh = show.meshes.add(cube(0.5));
  ShapeStore store;
  const Appearance look{mesh, true, "box"};
  DynObjectNode* body = nullptr;
  show.loader.files["show"] = [&](LoadedScene& load) {
    PlaceAttributes larger;
    larger.X_PN.linear() *= 2;
    addNode<MovingNode>(load, "larger", larger, false);
    PlaceAttributes above;
    above.parent = {load.number, 0}, above.X_PN.translation() = Vec3(0, 0, 2);
    BodyAttributes attributes;
    attributes.hooks = {"gravity"}, attributes.surface.restitution = 0.0;
    body = &addNode<DynObjectNode>(load, "body", above, look, attributes,
                                   store.fit(*show.meshes.find(mesh), look, Vec3::Ones()).value());
    addNode<Field>(load, "gravity", Vec3(0, 0, -10), true);
    addNode<Block>(load, "floor", mesh, Vec3(0, 0, -0.5));
    addNode<Sim>(load, "sim", std::vector<std::string>{"floor"}, std::vector<std::string>{"body"});
  };
  show.scene.open("show");
  show.frames(180);
  EXPECT_NEAR(body->state().pose.p.z(), 1, 1e-3) << "a cube of 2 m lies on the floor";
}

}  // namespace
}  // namespace stadion
