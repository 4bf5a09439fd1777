#include "engine/maths/functions.h"
#include "engine/nodes/path_node.h"
#include "engine/nodes/trigger_node.h"
#include "tests/engine/scene/show_fixture.h"

#include <gtest/gtest.h>

namespace stadion {
namespace {

/// A trigger whose kind the fixture need not know.
class HeadTrigger : public TriggerNode {
public:
  HeadTrigger(NodeRef self, std::string name, const Region& region)
      : TriggerNode(kUserTriggerType, self, std::move(name), {}, region, "head", true) {}
};

Region sphereAt(const Vec3& centre, double radius) {
  Region r;
  r.centre = centre, r.radius = radius;
  return r;
}

TEST(UserTrigger, AVisitorInsideAtTheFirstFrameEntersThen) {
  ShowFixture show;
  ListeningNode* listener = nullptr;
  show.loader.files["show"] = [&](LoadedScene& load) {
    addNode<HeadTrigger>(load, "zone", sphereAt({0, 0, 0}, 100))
        .addNotification(notify(Event("enter"), "listener", CommandId::Enable));
    listener = &addNode<ListeningNode>(load, "listener");
  };
  show.scene.open("show");
  show.frames(5);
  ASSERT_EQ(listener->heard.size(), 1u);
  EXPECT_EQ(listener->heard[0].frame, 1u);
}

TEST(UserTrigger, EventsCarryTheExactTimeOfTheCrossing) {
  ShowFixture show;
  ListeningNode* listener = nullptr;
  show.loader.files["show"] = [&](LoadedScene& load) {
    auto& zone = addNode<HeadTrigger>(load, "zone", sphereAt({0, 0, 0}, 1));
    zone.addNotification(notify(Event("enter"), "listener", CommandId::Enable, 1));
    zone.addNotification(notify(Event("exit"), "listener", CommandId::Disable, 1));
    listener = &addNode<ListeningNode>(load, "listener");
  };
  show.scene.open("show");
  for (int n = 0; n < 240; ++n) {  // walks along x at 2 m/s from -2 m
    show.head({-2 + 2 * toSeconds(signatureAt(show.next, 60).time), 0, 0});
    show.frame();
  }
  ASSERT_EQ(listener->heard.size(), 2u);
  EXPECT_NEAR(static_cast<double>(listener->heard[0].effective), 1.5e9, 2);
  EXPECT_NEAR(static_cast<double>(listener->heard[1].effective), 2.5e9, 2);
}

TEST(UserTrigger, BoxCrossingsAreFoundOnTheFaces) {
  Region box;
  box.form = Region::Form::Box;
  box.centre = {1, 0, 0}, box.halfSize = {1, 2, 3};
  EXPECT_TRUE(box.contains({0.01, 1.9, -2.9}));
  EXPECT_FALSE(box.contains({-0.01, 0, 0}));
  EXPECT_DOUBLE_EQ(box.crossing({-1, 0, 0}, {1, 0, 0}), 0.5);
  EXPECT_DOUBLE_EQ(box.crossing({1, 0, 0}, {1, 4, 0}), 0.5);
}

std::vector<Keyframe> square() {
  return {{0, {Vec3(0, 0, 0), Quat::Identity()}},
          {1, {Vec3(2, 0, 0), det::fromEuler(0, 0, 1)}},
          {2, {Vec3(2, 2, 0), det::fromEuler(0, 0, 2)}}};
}

TEST(Path, MovesItsTargetAlongTheKeysAndTellsWhenItIsDone) {
  ShowFixture show;
  PlacedNode* target = nullptr;
  ListeningNode* listener = nullptr;
  show.loader.files["show"] = [&](LoadedScene& load) {
    target = &addNode<MovingNode>(load, "target", PlaceAttributes{}, false);
    addNode<PathNode>(load, "path", PlaceAttributes{}, NodeRef{load.number, 0}, square(), false, false, true)
        .addNotification(notify(Event("finished"), "listener", CommandId::Enable, 1));
    listener = &addNode<ListeningNode>(load, "listener");
  };
  show.scene.open("show");
  show.frames(31);  // to 0.5 s
  EXPECT_NEAR(show.scene.placements().world(target->placement()).translation().x(), 1.0, 1e-9);
  show.frames(200);
  ASSERT_EQ(listener->heard.size(), 1u);
  EXPECT_EQ(listener->heard[0].effective, fromSeconds(3.0));
  EXPECT_TRUE(show.scene.placements().world(target->placement()).translation().isApprox(Vec3(2, 2, 0)));
}

TEST(Path, SmoothPathsGoThroughTheKeysAndKeepTheirSpeedThere) {
  const PathNode path({1, 0}, "p", {}, {}, square(), false, true, true);
  for (const Keyframe& key : square()) EXPECT_LT((path.poseAt(key.time).p - key.X_PN.p).norm(), 1e-12);
  const double h = 1e-6;
  const Vec3 before = (path.poseAt(1).p - path.poseAt(1 - h).p) / h,
             after = (path.poseAt(1 + h).p - path.poseAt(1).p) / h;
  EXPECT_LT((before - after).norm(), 1e-4);
}

}  // namespace
}  // namespace stadion
