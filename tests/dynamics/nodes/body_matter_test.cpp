/// Where a body's matter is: as its model filled evenly has it, or as the script states it.

#include "dynamics/nodes/body_maker.h"

#include "dynamics/collision/shape_choice.h"
#include "dynamics/nodes/dyn_object_node.h"
#include "engine/maths/functions.h"
#include "engine/script/script.h"
#include "tests/dynamics/nodes/show_nodes.h"
#include "tests/node_types.h"

#include <gtest/gtest.h>

namespace stadion {
namespace {

/// A bar along y: 0.2 m wide (x), 2 m long (y), 0.1 m thick (z), its middle at y = 0.5.
Mesh bar() {
  Mesh mesh = *show_nodes::cube(1);
  mesh.bounds = {};
  for (auto& p : mesh.positions) {
    p = {0.1F * p[0], 0.5F + p[1], 0.05F * p[2]};
    mesh.bounds.include(Vec3(p[0], p[1], p[2]));
  }
  return mesh;
}

struct Made {
  std::unique_ptr<Node> node;
  std::string findings;
  MassProperties mass() const {
    const auto& body = dynamic_cast<const DynObjectNode&>(*node);
    return body.body().massOf(*body.fit());
  }
};

Made made(const std::string& words, double scale = 1, bool standIn = false) {
  static Mesh mesh = bar();
  mesh.standIn = standIn;
  Diagnostics findings;
  const Document document =
      parseScript(SourceText::make("a.evs", "dynobject( name=a, file=a.obj, mass=3" + words + " )\n").value(),
                  testTypes(), findings);
  NodeServices services;
  PlaceAttributes place;
  place.X_PN.linear() *= scale;
  const std::function<NodeRef(const NodeReference&)> resolve;
  const std::function<std::optional<PlacedModel>(const NodeReference&)> model;
  const NodeRequest request{document[0], {}, "a", place, {}, &mesh, resolve, model, findings, services};
  Made m{makeDynObject(request), ""};
  for (const Diagnostic& d : findings.all()) m.findings += format(d) + "\n";
  return m;
}

/// The moment about an axis of the model.
double about(const MassProperties& m, const Vec3& axis) {
  const Vec3 k = m.axes.conjugate() * axis;
  return k.cwiseProduct(k).dot(m.inertia);
}

TEST(BodyMatter, FillsTheModelEvenlyIfTheScriptSaysNothing) {
  const MassProperties m = made("").mass();
  EXPECT_EQ(m.mass, 3);
  EXPECT_LT((m.centre - Vec3(0, 0.5, 0)).norm(), 1e-6);
  EXPECT_NEAR(about(m, Vec3::UnitX()), (4 + 0.01) / 4, 1e-6);
}

TEST(BodyMatter, IsWhereTheScriptSaysAndGrowsWithTheModel) {
  const MassProperties one = made(", centre=\"0.05, 0.9, 0\"").mass();
  EXPECT_LT((one.centre - Vec3(0.05, 0.9, 0)).norm(), 1e-12);
  EXPECT_NEAR(about(one, Vec3::UnitX()), (4 + 0.01) / 4, 1e-6) << "its moments stay";
  const MassProperties twice = made(", centre=\"0.05, 0.9, 0\", inertia=\"1, 2, 2.5\"", 2).mass();
  EXPECT_LT((twice.centre - Vec3(0.1, 1.8, 0)).norm(), 1e-12);
  EXPECT_NEAR(about(twice, Vec3::UnitY()), 1, 1e-9) << "moments are stated for the body as it is";
}

TEST(BodyMatter, MomentsAreOfTheLongestTheMiddleAndTheShortestAxisWhateverTheModelsAxesAre) {
  for (const char* shape : {"", ", shape=box", ", shape=convex"}) {
    const MassProperties m = made(std::string(", inertia=\"0.5, 0.8, 0.9\"") + shape).mass();
    EXPECT_NEAR(about(m, Vec3::UnitY()), 0.5, 1e-9) << shape;  // the longest
    EXPECT_NEAR(about(m, Vec3::UnitX()), 0.8, 1e-9) << shape;
    EXPECT_NEAR(about(m, Vec3::UnitZ()), 0.9, 1e-9) << shape;
  }
}

TEST(BodyMatter, ACentreOutsideOfTheModelIsRefusedWithWhereTheModelIs) {
  const Made out = made(", centre=\"0, 1.6, 0\"");
  EXPECT_EQ(out.node, nullptr);
  EXPECT_TRUE(out.findings.starts_with(
      "a.evs:1:48: error: the centre of mass lies outside of the model, which reaches "
      "from \"-0.1, -0.5, -0.05\" to \"0.1, 1.5, 0.05\" m"))
      << out.findings;
  EXPECT_NE(made(", centre=\"0, 1.5, 0\"").node, nullptr) << "its end is still in it";
  EXPECT_NE(made(", centre=\"0, 1.6, 0\"", 1, true).node, nullptr) << "a missing model is told by itself";
}

TEST(BodyMatter, MoreInertiaThanAnyBodyOfThatSizeHasIsToldAsAWarning) {
  EXPECT_EQ(made(", inertia=\"1, 2, 2\"").findings, "");
  const Made heavy = made(", inertia=\"100, 100, 100\"");
  EXPECT_NE(heavy.node, nullptr);
  EXPECT_NE(heavy.findings.find("a.evs:1:49: warning: no body of 3 kg within "), std::string::npos)
      << heavy.findings;
}

TEST(BodyMatter, TooLittleInertiaToBeFollowedInContactIsRefusedWithTheLeastThatIsNot) {
  const Made thin = made(", inertia=\"1e-5, 1e-5, 1e-5\"");
  EXPECT_EQ(thin.node, nullptr);
  EXPECT_NE(
      thin.findings.find("a.evs:1:49: error: the moments must be at least \"0.000125, 0.01, 0.0101\" kg*m2"),
      std::string::npos)
      << thin.findings;
  EXPECT_NE(made(", inertia=\"0.00013, 0.0102, 0.0102\"").node, nullptr);
}

/// A ball that carries its weight low: put down askew, it comes to rest upright.
TEST(BodyMatter, ABallWithALowCentreRightsItself) {
  World world;
  ForceField gravity;
  gravity.law = LinearField{Vec3(0, 0, -9.81), LinearField::Unit::Acceleration};
  const FieldId down = world.addField(gravity, true);
  world.addCollider({world.addShape(PlaneShape{}), {}, {}});
  BodyAttributes attributes;
  attributes.mass = 1, attributes.centre = Vec3(0, 0, -0.05);
  ShapeChoice ball;
  ball.shape = BallShape{Vec3::Zero(), 0.1}, ball.kind = ShapeKind::Ball;
  const FittedShape fit{Vec3::Ones(), std::move(ball), massOfSphere(Vec3::Zero(), 0.1, 1), 0};
  BodyDef def;
  def.shape = world.addShape(BallShape{Vec3::Zero(), 0.1});
  def.mass = attributes.massOf(fit);
  def.pose.p = Vec3(0, 0, 0.1), def.pose.q = det::expRotation(Vec3(1.2, 0, 0));
  def.surface.restitution = 0, def.surface.rolling = 0.05;
  const BodyId id = world.addBody(def);
  world.hook(id, down, 0);
  for (int frame = 0; frame < 60 * 20; ++frame)
    world.advance(fromSeconds(frame / 60.0), fromSeconds((frame + 1) / 60.0));
  EXPECT_GT((world.pose(id).q * Vec3::UnitZ()).z(), 0.99);
  EXPECT_NEAR(world.pose(id).p.z(), 0.1, 1e-3);
}

}  // namespace
}  // namespace stadion
