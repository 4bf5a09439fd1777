#include "engine/nodes/path_node.h"
#include "tests/engine/scene/show_fixture.h"

#include <gtest/gtest.h>

namespace stadion {
namespace {

/// A path of two seconds along x at 1 m/s, its target, and a node that hears when it has finished.
struct PathShow : ShowFixture {
  PlacedNode* target = nullptr;
  ListeningNode* listener = nullptr;

  explicit PathShow(bool loop, double framesPerSecond = 60) {
    rate = framesPerSecond;
    loader.files["show"] = [this, loop](LoadedScene& load) {
      target = &addNode<MovingNode>(load, "target", PlaceAttributes{}, false);
      const std::vector<Keyframe> keys{{0, {Vec3(0, 0, 0), Quat::Identity()}},
                                       {2, {Vec3(2, 0, 0), Quat::Identity()}}};
      addNode<PathNode>(load, "path", PlaceAttributes{}, NodeRef{load.number, 0}, keys, loop, false, true)
          .addNotification(notify(Event("finished"), "listener", CommandId::Toggle, 0.5));
      listener = &addNode<ListeningNode>(load, "listener");
    };
    scene.open("show");
  }
  double x() { return scene.placements().world(target->placement()).translation().x(); }
  void until(double seconds) {
    while (signatureAt(next, rate).time <= fromSeconds(seconds)) frame();
  }
};

TEST(PathCommands, DisableLeavesTheTargetWhereItIsAtTheCommandsTimeAtAnyRate) {
  for (const double rate : {30.0, 50.0, 60.0, 240.0}) {
    PathShow show(false, rate);
    show.until(0.9);
    show.scene.command("path", CommandId::Disable, {}, fromSeconds(1.2345));
    show.until(2.5);
    EXPECT_NEAR(show.x(), 1.2345, 1e-9) << rate;
    EXPECT_TRUE(show.listener->heard.empty());
  }
}

TEST(PathCommands, EnableGoesOnWhereDisableStopped) {
  PathShow show(false);
  show.scene.command("path", CommandId::Disable, {}, fromSeconds(0.5));
  show.scene.command("path", CommandId::Enable, {}, fromSeconds(1.005));
  show.until(1.5);
  EXPECT_NEAR(show.x(), 0.995, 1e-9);
  show.until(4);
  ASSERT_EQ(show.listener->heard.size(), 1u);
  EXPECT_EQ(show.listener->heard[0].effective, fromSeconds(2.505 + 0.5));
}

TEST(PathCommands, EnableAfterTheEndPlaysItAgainFromTheFirstKey) {
  PathShow show(false);
  show.until(3);
  EXPECT_NEAR(show.x(), 2, 1e-12);
  show.scene.command("path", CommandId::Enable, {}, fromSeconds(3.01));
  show.until(4);
  EXPECT_NEAR(show.x(), 0.99, 1e-9);
  show.until(6);
  ASSERT_EQ(show.listener->heard.size(), 2u);
  EXPECT_EQ(show.listener->heard[1].effective, fromSeconds(5.01 + 0.5));
}

TEST(PathCommands, ACommandThatComesAfterTheEndInTheSameFrameFindsTheTargetAtTheEnd) {
  PathShow show(false, 2);
  show.scene.command("path", CommandId::Show, {}, fromSeconds(2.2));
  show.until(3);
  EXPECT_NEAR(show.x(), 2, 1e-12);
  EXPECT_EQ(show.scene.events().size(), 0u);
  show.until(4);
  ASSERT_EQ(show.listener->heard.size(), 1u);
}

TEST(PathCommands, ALoopTellsTheExactEndOfEachPass) {
  for (const double rate : {1.0, 24.0, 60.0}) {
    PathShow show(true, rate);
    show.until(7);
    ASSERT_EQ(show.listener->heard.size(), 3u) << rate;
    for (std::size_t i = 0; i < 3; ++i)
      EXPECT_EQ(show.listener->heard[i].effective, fromSeconds(2.0 * static_cast<double>(i + 1) + 0.5));
    EXPECT_NEAR(show.x(), 1, 1e-9);
  }
}

}  // namespace
}  // namespace stadion
