/// Lights and cameras of a model's file in a show.

#include "engine/scene/placed_node.h"
#include "engine/scene/scene.h"
#include "tests/engine/asset/gltf_builder.h"
#include "tests/programs/program.h"
#include "tests/show/player/played_show.h"

#include <gtest/gtest.h>

namespace stadion::test {
namespace {

/// A plate with a lamp 3 m above it and a camera 5 m south of it, 2 m up, that looks north and a little down.
GltfBuilder litPlate() {
  GltfBuilder b;
  b.square();
  b.json["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 0.1}}}}};
  b.json["extensionsUsed"] = {"KHR_lights_punctual"};
  b.json["extensions"]["KHR_lights_punctual"]["lights"] = {
      {{"type", "point"}, {"color", {1, 0.5, 0}}, {"intensity", 3.141592653589793}, {"range", 8}}};
  b.json["nodes"] = nlohmann::json::parse(
      R"([{"mesh": 0}, {"name": "lamp", "translation": [0, 3, 0], "extensions": {"KHR_lights_punctual": {"light": 0}}},
          {"name": "front", "camera": 0, "translation": [0, 2, 5], "rotation": [-0.0871557, 0, 0, 0.9961947]}])");
  b.json["scenes"][0]["nodes"] = {0, 1, 2};
  return b;
}

struct LitShow : SteppedShow {
  explicit LitShow(const std::string& script) {
    folder.write("plate.glb", litPlate().glb());
    player = openShow(folder.write("show.evs", script));
  }
  TestFolder folder;
};

TEST(ModelContent, ALightTakesItsPlaceAndKindFromTheFileOfItsParent) {
  LitShow show("object( name=plate, file=plate.glb, position=\"10, 0, 0\" )\n"
               "light( parent=plate, source=lamp, intensity=2 )\n");
  ASSERT_TRUE(show.player);
  show.play(1);
  ASSERT_EQ(show.changes.lights.size(), 1u);
  const LightRecord& light = show.changes.lights[0];
  EXPECT_EQ(light.kind, 1u);
  EXPECT_TRUE(light.fallsOff);
  EXPECT_FLOAT_EQ(light.range, 8);
  EXPECT_LT((Vec3(light.position) - Vec3(10, 0, 3)).norm(), 1e-6);
  EXPECT_FLOAT_EQ(light.colour[0], 2);
  EXPECT_FLOAT_EQ(light.colour[1], 1);
}

TEST(ModelContent, WhatALightStatesReplacesTheFiles) {
  LitShow show("object( name=plate, file=plate.glb )\n"
               "light( parent=plate, source=lamp, type=spot, direction=\"0, 1, 0\", range=4, falloff=range, "
               "colour=\"0, 0, 1\" )\n");
  ASSERT_TRUE(show.player);
  show.play(1);
  const LightRecord& light = show.changes.lights.at(0);
  EXPECT_EQ(light.kind, 2u);
  EXPECT_FALSE(light.fallsOff);
  EXPECT_FLOAT_EQ(light.range, 4);
  EXPECT_FLOAT_EQ(light.colour[2], 1);
  EXPECT_FLOAT_EQ(light.colour[0], 0);
  EXPECT_NEAR(light.direction[1], 1, 1e-12);
}

TEST(ModelContent, ARigStartsAtACameraAndStandsUpright) {
  LitShow show("object( name=plate, file=plate.glb, position=\"10, 0, 0\", orientation=\"0, 0, 90\" )\n"
               "rig( name=rig, model=plate, camera=front, eyeheight=1.5 )\n");
  ASSERT_TRUE(show.player);
  show.play(1);
  const Pose rig = show.changes.viewer.rig();
  EXPECT_LT((rig.p - Vec3(15, 0, 0.5)).norm(), 1e-6);
  EXPECT_LT((rig.q * Vec3::UnitY() - Vec3(-1, 0, 0)).norm(), 1e-6);
  EXPECT_LT((rig.q * Vec3::UnitZ() - Vec3(0, 0, 1)).norm(), 1e-9);
}

TEST(ModelContent, ANameThatTheFileDoesNotHaveIsAnErrorWithThoseThatItHas) {
  for (const char* line : {"light( parent=plate, source=sun )\n", "rig( model=plate, camera=back )\n"}) {
    const LitShow show(std::string("object( name=plate, file=plate.glb )\n") + line);
    EXPECT_FALSE(show.player) << line;
  }
}

}  // namespace
}  // namespace stadion::test
