#include "engine/nodes/light_node.h"
#include "engine/nodes/scene_node.h"
#include "tests/engine/scene/show_fixture.h"

#include <gtest/gtest.h>

namespace stadion {
namespace {

SkyRecord skyOf(float red) {
  SkyRecord sky;
  sky.zenith[0] = red;
  return sky;
}

LightRecord lamp(float brightness, double x = 0) {
  LightRecord light;
  light.kind = 1;  // point
  light.range = 100;
  light.position[0] = x;
  for (float& c : light.colour) c = brightness;
  return light;
}

TEST(Sky, TheSkyOfASubSceneGivesWayToTheOneBeforeWhenItIsUnloaded) {
  ShowFixture show;
  show.loader.files["inner"] = [](LoadedScene& load) { addNode<SkyNode>(load, "night", skyOf(0.9f)); };
  show.loader.files["show"] = [](LoadedScene& load) {
    addNode<SkyNode>(load, "day", skyOf(0.1f));
    addNode<SceneNode>(load, "inner", PlaceAttributes{}, "inner", Nanoseconds{0}, true);
  };
  show.scene.open("show");
  show.frame();
  EXPECT_EQ(show.changes.sky.zenith[0], 0.9f);
  show.scene.command("inner", CommandId::Unload, {}, 0);
  show.frames(3);
  EXPECT_EQ(show.changes.sky.zenith[0], 0.1f);
}

TEST(Sky, TheLastSkyToComeIsSeenWhicheverGoesFirst) {
  ShowFixture show;
  show.loader.files["a"] = [](LoadedScene& load) { addNode<SkyNode>(load, "", skyOf(0.2f)); };
  show.loader.files["b"] = [](LoadedScene& load) { addNode<SkyNode>(load, "", skyOf(0.3f)); };
  show.loader.files["show"] = [](LoadedScene& load) {
    addNode<SceneNode>(load, "a", PlaceAttributes{}, "a", Nanoseconds{0}, true);
    addNode<SceneNode>(load, "b", PlaceAttributes{}, "b", Nanoseconds{0}, true);
  };
  show.scene.open("show");
  show.frame();
  EXPECT_EQ(show.changes.sky.zenith[0], 0.3f);
  show.scene.command("a", CommandId::Unload, {}, 0);
  show.frames(3);
  EXPECT_EQ(show.changes.sky.zenith[0], 0.3f);
  show.scene.command("b", CommandId::Unload, {}, 0);
  show.frames(3);
  EXPECT_EQ(show.changes.sky.zenith[0], SkyRecord{}.zenith[0]) << "back to what a show without sky has";
}

TEST(Light, HideMakesItDarkAndShowBrightAgain) {
  ShowFixture show;
  show.loader.files["show"] = [](LoadedScene& load) {
    addNode<LightNode>(load, "lamp", PlaceAttributes{}, lamp(1), true);
  };
  show.scene.open("show");
  show.frame();
  ASSERT_EQ(show.changes.lights.size(), 1u);
  show.scene.command("lamp", CommandId::Hide, {}, 0);
  show.frame();
  EXPECT_TRUE(show.changes.lightsChanged);
  EXPECT_TRUE(show.changes.lights.empty()) << "neither the lamp nor the sun of a show without light";
  show.scene.command("lamp", CommandId::Show, {}, 0);
  show.frame();
  EXPECT_EQ(show.changes.lights.size(), 1u);
}

TEST(Light, HidingTheGroupAboveDarkensIt) {
  ShowFixture show;
  show.loader.files["show"] = [](LoadedScene& load) {
    addNode<MovingNode>(load, "group", PlaceAttributes{}, false);
    PlaceAttributes below;
    below.parent = {load.number, 0};
    addNode<LightNode>(load, "lamp", below, lamp(1), true);
  };
  show.scene.open("show");
  show.frame();
  show.scene.command("group", CommandId::Hide, {}, 0);
  show.frame();
  EXPECT_TRUE(show.changes.lightsChanged);
  EXPECT_TRUE(show.changes.lights.empty());
}

/// Lights along x, one a metre, brighter from one to the next.
struct ManyLights : ShowFixture {
  explicit ManyLights(std::size_t count) {
    loader.files["show"] = [count](LoadedScene& load) {
      load.file = "many.evs";
      for (std::size_t i = 0; i < count; ++i) {
        LightRecord light = lamp(1, 100 * static_cast<double>(i));
        addNode<LightNode>(load, i % 2 == 0 ? "" : "lamp" + std::to_string(i), PlaceAttributes{}, light,
                           true);
        load.lines.push_back(static_cast<std::uint32_t>(i + 1));
      }
    };
    scene.open("show");
  }
  std::vector<double> places() const {
    std::vector<double> x;
    for (const LightRecord& l : changes.lights) x.push_back(l.position[0]);
    return x;
  }
};

TEST(Light, OfMoreThanSixteenThoseShineThatAreBrightestWhereTheVisitorIs) {
  ManyLights show(40);
  show.head({0, 0, 0});
  show.frame();
  std::vector<double> expected;
  for (int i = 0; i < 16; ++i) expected.push_back(100 * i);
  EXPECT_EQ(show.places(), expected);
  show.frame();
  EXPECT_FALSE(show.changes.lightsChanged) << "nothing moved";
  show.head({3900, 0, 0});
  show.frame();
  ASSERT_TRUE(show.changes.lightsChanged);
  for (int i = 0; i < 16; ++i) expected[static_cast<std::size_t>(i)] = 100 * (24 + i);
  EXPECT_EQ(show.places(), expected);
}

TEST(Light, TooManyAreToldOnceWithTheNamesOfThoseThatAreDark) {
  ManyLights show(20);
  show.frames(10);
  ASSERT_EQ(show.loader.reported.size(), 1u);
  const std::string told = format(show.loader.reported[0]);
  EXPECT_EQ(told,
            "many.evs:17:1: warning: 20 lights are on, of which the 16 brightest where the visitor is shine; "
            "dark at the moment: line 17, \"lamp17\", line 19, \"lamp19\"");
  ManyLights enough(16);
  enough.frames(2);
  EXPECT_TRUE(enough.loader.reported.empty());
}

}  // namespace
}  // namespace stadion
