/// What moves bodies from outside is followed inside the frame: the rate does not matter.

#include "engine/maths/functions.h"
#include "engine/nodes/path_node.h"
#include "tests/dynamics/nodes/show_nodes.h"
#include "tests/dynamics/world/scenes.h"

#include <gtest/gtest.h>

namespace stadion {
namespace {

using namespace show_nodes;

Keyframe key(double time, const Vec3& p, double yaw = 0) {
  return {time, {p, det::fromEuler(0, 0, yaw)}};
}

/// A platform below a group that a path moves, and a ball on it.
struct Lift : ShowFixture {
  Ball* ball = nullptr;

  Lift(double framesPerSecond, std::vector<Keyframe> keys, bool smooth) {
    rate = framesPerSecond;
    const MeshId mesh = meshes.add(cube(1));
    loader.files["show"] = [=, this](LoadedScene& load) {
      Block& platform = addNode<Block>(load, "platform", mesh, Vec3(0, 0, 0));
      addNode<PathNode>(load, "drive", PlaceAttributes{}, platform.self(), keys, false, smooth, true);
      addNode<Field>(load, "gravity", Vec3(0, 0, -9.81), true);
      ball = &addNode<Ball>(load, "ball", Vec3(0.3, 0, 1.1), std::vector<std::string>{"gravity"});
      addNode<Sim>(load, "sim", std::vector<std::string>{"platform"}, std::vector<std::string>{"ball"});
    };
    scene.open("show");
  }
  Vec3 after(double seconds) {
    while (signatureAt(next, rate).time <= fromSeconds(seconds)) frame();
    return ball->state().p;
  }
};

TEST(InsideFrames, AStraightPathTurnsAtItsKeysNotAtFrames) {
  const std::vector<Keyframe> keys{key(0, {0, 0, 0}), key(0.517, {0, 0, 0}), key(1.017, {0, 0, 3}),
                                   key(1.1, {0, 0, 3}), key(3, {0, 0, 0})};
  const Vec3 truth = Lift(240, keys, false).after(2);
  EXPECT_GT(truth.z(), 2);
  for (const double rate : {30.0, 60.0, 144.0})
    EXPECT_LT((Lift(rate, keys, false).after(2) - truth).norm(), 1e-9) << rate;
}

TEST(InsideFrames, ASmoothTurningPathIsFollowedByShortChords) {
  const std::vector<Keyframe> keys{key(0, {0, 0, 0}), key(0.7, {0.2, 0.1, 0.3}, 0.4),
                                   key(1.5, {0, 0.3, 0.1}, 1)};
  const Vec3 truth = Lift(240, keys, true).after(1.5);
  for (const double rate : {30.0, 60.0, 144.0})
    EXPECT_LT((Lift(rate, keys, true).after(1.5) - truth).norm(), 5e-4) << rate;
}

/// Repels from the body that carries it.
class Shield : public FieldNode {
public:
  Shield(NodeRef self, std::string name, NodeRef carrier)
      : FieldNode(kForceSphericalType, self, std::move(name), below(carrier),
                  {SphericalField{3, 2, SphericalField::Falloff::Square}, 0, true, {}}) {}

private:
  static PlaceAttributes below(NodeRef carrier) {
    PlaceAttributes place;
    place.parent = carrier;
    return place;
  }
};

TEST(InsideFrames, AFieldOnABodyOfTheSameWorldDoesNotLag) {
  const auto avoided = [](double rate) {
    ShowFixture show;
    show.rate = rate;
    Ball* other = nullptr;
    show.loader.files["show"] = [&](LoadedScene& load) {
      Ball& a = addNode<Ball>(load, "a", Vec3::Zero(), std::vector<std::string>{"push"});
      addNode<Field>(load, "push", Vec3(4.9, 0, 0), true, 1);
      addNode<Shield>(load, "shield", a.self());
      other = &addNode<Ball>(load, "b", Vec3(4, 0.3, 0), std::vector<std::string>{"shield"});
      addNode<Sim>(load, "sim", std::vector<std::string>{}, std::vector<std::string>{"a", "b"});
    };
    show.scene.open("show");
    while (signatureAt(show.next, rate).time <= fromSeconds(2)) show.frame();
    return other->state().p;
  };
  const Vec3 truth = avoided(240);
  EXPECT_GT(truth.y(), 0.5);
  for (const double rate : {30.0, 60.0, 144.0}) EXPECT_LT((avoided(rate) - truth).norm(), 1e-5) << rate;
}

TEST(InsideFrames, NothingFliesThroughARegionUnnoticed) {
  for (const MediumField::Region region : {MediumField::Region::Box, MediumField::Region::Ball}) {
    double slowest = 1e300, fastest = 0;
    for (int i = 0; i < 16; ++i) {
      World w;
      ForceField water;
      water.law = MediumField{.density = 1000, .region = region, .centre = {50, 0, 0}, .half = {0.2, 4, 4}};
      const FieldId field = w.addField(water, true);
      BodyDef def;
      def.shape = w.addShape(BallShape{Vec3::Zero(), 0.1});
      def.pose.p = {0.17 * i, 0, 0}, def.v = {50, 0, 0};
      def.mass = massOfSphere(Vec3::Zero(), 0.1, 1).withMass(100);
      def.dragArea = 0.01;
      const BodyId ball = w.addBody(def);
      w.hook(ball, field, 0);
      w.advance(0, fromSeconds(1.5));
      slowest = std::min(slowest, w.state(ball).v.x()), fastest = std::max(fastest, w.state(ball).v.x());
    }
    EXPECT_LT(fastest, 49.5);
    EXPECT_NEAR(slowest, fastest, 1e-3);
  }
}

}  // namespace
}  // namespace stadion
