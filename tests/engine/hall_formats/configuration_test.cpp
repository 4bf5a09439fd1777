/// Configurations of SGCT and nDisplay: where their pictures stand, and what is named or refused.

#include "engine/hall_formats/ndisplay_reader.h"
#include "engine/hall_formats/sgct_reader.h"
#include "engine/maths/angles.h"
#include "tests/engine/hall_formats/hall_samples.h"

#include <gtest/gtest.h>

namespace stadion {
namespace {

using hall_samples::FakeFiles;

template <class Reader>
std::optional<WallFile> hallOf(const Reader& reader, const std::string& text, std::string* all = nullptr,
                               const FakeFiles& files = {}) {
  Diagnostics out;
  auto hall = reader(text, "t.json", files.reader(), out);
  if (all) *all = hall_samples::said(out);
  EXPECT_TRUE(hall || out.hasErrors());
  return hall;
}

std::string sgctOf(const std::string& projection, const std::string& viewport = "") {
  return R"({"version": 1, "masteraddress": "x", "nodes": [{"address": "x", "port": 1, "windows": [
    {"size": {"x": 800, "y": 600}, "pos": {"x": 10, "y": 20}, "viewports": [
      {"pos": {"x": 0.5, "y": 0}, "size": {"x": 0.5, "y": 0.5}, )" +
         viewport + R"("projection": )" + projection + R"(}]}]}],
    "users": [{"eyeseparation": 0.06, "pos": {"x": 0, "y": 1.5, "z": 2}}]})";
}

TEST(Sgct, APlaneIsAWallInTheAxesOfTheRig) {
  std::string all;
  const auto hall =
      hallOf(readSgct, sgctOf(R"({"type": "ProjectionPlane", "lowerleft": {"x": -2, "y": 0, "z": -3},
      "upperleft": {"x": -2, "y": 2, "z": -3}, "upperright": {"x": 2, "y": 2, "z": -3}})"),
             &all);
  ASSERT_TRUE(hall) << all;
  EXPECT_EQ(hall->walls[0].wall.lowerLeft, Vec3(-2, 3, 0));
  EXPECT_EQ(hall->walls[0].wall.lowerRight, Vec3(2, 3, 0));
  EXPECT_EQ(hall->walls[0].wall.upperLeft, Vec3(-2, 3, 2));
  EXPECT_EQ(hall->visitor.eye, Vec3(0, -2, 1.5));
  EXPECT_EQ(hall->eyeSeparation, 0.06);
  // The viewport is the lower right quarter of the window.
  EXPECT_EQ(*hall->walls[0].output->place.rectangle, (OutputPlace::Rectangle{410, 320, 400, 300}));
}

TEST(Sgct, AViewStandsBeforeItsUser) {
  const auto hall =
      hallOf(readSgct, sgctOf(R"({"type": "PlanarProjection", "fov": {"hfov": 90, "vfov": 90, "distance": 2},
      "orientation": {"yaw": -90, "pitch": 0, "roll": 0}})"));
  ASSERT_TRUE(hall);
  EXPECT_LT((hall->walls[0].wall.centre() - Vec3(2, -2, 1.5)).norm(), 1e-9);
  EXPECT_LT((hall->walls[0].wall.lowerLeft - Vec3(2, 0, -0.5)).norm(), 1e-9);
}

TEST(Sgct, AFisheyeIsALensInTheMiddleOfADome) {
  const auto hall =
      hallOf(readSgct, sgctOf(R"({"type": "FisheyeProjection", "fov": 180, "tilt": 30, "diameter": 10})"));
  ASSERT_TRUE(hall);
  const auto& dome = std::get<SphereScreen>(hall->screens[0].surface);
  EXPECT_EQ(dome.radius, 5);
  EXPECT_NEAR(dome.lowest, 0, 1e-12);
  const auto& lens = std::get<FisheyeImage>(hall->walls[0].projector->image);
  EXPECT_LT((lens.X_RP.q * Vec3::UnitY() - Vec3(0, 0.5, std::sqrt(0.75))).norm(), 1e-9);
  EXPECT_LT((lens.X_RP.q * Vec3::UnitX() - Vec3::UnitX()).norm(), 1e-9);
}

TEST(Sgct, RoundPicturesLieOnRoundScreens) {
  const auto sphere = hallOf(readSgct, sgctOf(R"({"type": "EquirectangularProjection"})"));
  ASSERT_TRUE(sphere);
  const auto& image = std::get<MeasuredImage>(sphere->walls[0].projector->image);
  const Vec3 middle = image.points[image.points.size() / 2 + image.columns / 2] - sphere->visitor.eye;
  EXPECT_NEAR(middle.norm(), 7.4, 1e-9);
  EXPECT_GT(middle.y(), 7.39);
  const auto cylinder = hallOf(readSgct, sgctOf(R"({"type": "CylindricalProjection", "radius": 4})"));
  ASSERT_TRUE(cylinder);
  EXPECT_EQ(std::get<CylinderScreen>(cylinder->screens[0].surface).radius, 4);
  EXPECT_EQ(hallOf(readSgct, sgctOf(R"({"type": "CubemapProjection"})"))->walls.size(), 6u);
}

TEST(Sgct, AMeshWarpsAPlane) {
  FakeFiles files;
  files.files["half.data"] = "2\n2 2\n-1.3333333333 -1 0 0 1\n0 -1 1 0 1\n-1.3333333333 1 0 1 1\n0 1 1 1 1\n";
  std::string all;
  const auto hall = hallOf(readSgct,
                           sgctOf(R"({"type": "TextureMappedProjection", "fov": {"hfov": 90, "vfov": 90}})",
                                  R"("mesh": "half.data", "eye": "left", )"),
                           &all, files);
  ASSERT_TRUE(hall) << all;
  const Projector& projector = *hall->walls[0].projector;
  EXPECT_EQ(projector.eye, Eye::Left);
  const auto& image = std::get<MeasuredImage>(projector.image);
  EXPECT_TRUE(image.points[0].allFinite());
  EXPECT_FALSE(image.points[image.columns - 1].allFinite());
  EXPECT_FALSE(hallOf(readSgct,
                      sgctOf(R"({"type": "TextureMappedProjection", "fov": {"hfov": 90, "vfov": 90}})",
                             R"("mesh": "none.data", )"),
                      &all));
  EXPECT_NE(all.find("/nodes/0/windows/0/viewports/0: mesh \"none.data\": there is no file"),
            std::string::npos)
      << all;
}

TEST(Sgct, WhatIsNotUnderstoodIsNamedWithItsPath) {
  std::string all;
  ASSERT_TRUE(hallOf(readSgct, sgctOf(R"({"type": "EquirectangularProjection", "colour": 1})"), &all));
  EXPECT_NE(all.find("/nodes/0/windows/0/viewports/0/projection/colour is not understood; it has no effect"),
            std::string::npos)
      << all;
  EXPECT_NE(all.find("say nothing about the hall: masteraddress, port"), std::string::npos) << all;
  EXPECT_FALSE(hallOf(readSgct, "{\"nodes\": [}", &all));
  EXPECT_NE(all.find("1: error: this is not sound JSON"), std::string::npos) << all;
  EXPECT_FALSE(hallOf(readSgct, "[]"));
  EXPECT_FALSE(hallOf(readSgct, "{\"nodes\": 3}"));
}

const char* const kNdisplay = R"({"nDisplay": {"description": "", "version": "5.00", "misc": {},
  "scene": {"xforms": {"centre": {"parentId": "", "location": {"x": 0, "y": 0, "z": 110}, "rotation": {"pitch": 0, "yaw": 0, "roll": 0}},
                       "corner": {"parentId": "centre", "location": {"x": 150, "y": 150, "z": 0}, "rotation": {"pitch": 0, "yaw": 90, "roll": 0}}},
            "cameras": {"eye": {"interpupillaryDistance": 6.2, "swapEyes": false, "stereoOffset": "none", "parentId": "",
                                "location": {"x": -20, "y": 10, "z": 50}, "rotation": {"pitch": 0, "yaw": 0, "roll": 0}}},
            "screens": {"right": {"parentId": "corner", "size": {"width": 300, "height": 200},
                                  "location": {"x": 0, "y": 150, "z": 0}, "rotation": {"pitch": 0, "yaw": 0, "roll": 0}}}},
  "cluster": {"nodes": {"one": {"host": "h", "window": {"x": 100, "y": 0, "w": 800, "h": 600}, "viewports": {
     "vp": {"camera": "eye", "gPUIndex": 1, "bufferRatio": 1, "region": {"x": 10, "y": 20, "w": 600, "h": 400},
            "projectionPolicy": {"type": "Simple", "parameters": {"screen": "right"}}},
     "mesh": {"region": {"x": 0, "y": 0, "w": 60, "h": 40}, "projectionPolicy": {"type": "mesh", "parameters": {"mesh_component": "Asset"}}},
     "blend": {"region": {"x": 0, "y": 0, "w": 60, "h": 40}, "strange": 1, "projectionPolicy": {"type": "vioso", "parameters": {}}}}}}}}})";

TEST(Ndisplay, ScreensHangOnATreeOfTransforms) {
  std::string all;
  const auto hall = hallOf(readNdisplayJson, kNdisplay, &all);
  ASSERT_TRUE(hall) << all;
  ASSERT_EQ(hall->walls.size(), 1u);
  const Wall& wall = hall->walls[0].wall;
  // The right wall of a room 3 m wide: its left edge is at the front, 1.5 m before the middle.
  EXPECT_LT((wall.lowerLeft - Vec3(1.5, 1.5, 0.1)).norm(), 1e-9);
  EXPECT_LT((wall.lowerRight - Vec3(1.5, -1.5, 0.1)).norm(), 1e-9);
  EXPECT_LT((wall.upperLeft - Vec3(1.5, 1.5, 2.1)).norm(), 1e-9);
  EXPECT_EQ(hall->walls[0].card, 1u);
  EXPECT_EQ(*hall->walls[0].output->place.rectangle, (OutputPlace::Rectangle{110, 20, 600, 400}));
  EXPECT_LT((hall->visitor.eye - Vec3(0.1, -0.2, 0.5)).norm(), 1e-12);
  EXPECT_NEAR(hall->eyeSeparation, 0.062, 1e-12);
  EXPECT_NE(all.find("/viewports/blend/strange is not understood"), std::string::npos) << all;
  EXPECT_NE(all.find("the projection policy \"vioso\" is not understood; the viewport is left out"),
            std::string::npos);
  EXPECT_NE(all.find("the mesh \"Asset\" is an asset of the game engine"), std::string::npos);
}

TEST(Ndisplay, AScreenThatIsMissingIsAnError) {
  std::string text = kNdisplay, all;
  text.replace(text.find("\"screen\": \"right\""), 17, "\"screen\": \"rigth\"");
  EXPECT_FALSE(hallOf(readNdisplayJson, text, &all));
  EXPECT_NE(all.find("there is no screen or transform \"rigth\"; did you mean \"right\"?"), std::string::npos)
      << all;
  text = kNdisplay;
  text.replace(text.find("\"parentId\": \"\""), 14, "\"parentId\": \"corner\"");
  EXPECT_FALSE(hallOf(readNdisplayJson, text, &all));
  EXPECT_NE(all.find("form a circle"), std::string::npos) << all;
}

TEST(Ndisplay, OlderFilesAreLines) {
  const std::string text =
      "# comment\n[info] version=\"23\"\n[cluster_node] id=\"n\" addr=\"127.0.0.1\" window=\"w\" "
      "master=\"true\"\n"
      "[window] id=\"w\" viewports=\"a,vp_demo\" fullscreen=\"false\" WinX=\"5\" WinY=\"6\" ResX=\"800\" "
      "ResY=\"800\"\n"
      "[screen] id=\"scr\" loc=\"X=2,Y=0,Z=0\" rot=\"P=0,Y=0,R=0\" size=\"X=1,Y=1\" parent=\"up\" odd=1\n"
      "[scene_node] id=up loc=\"Z=1.5\" rot=\"P=0\"\n"
      "[viewport] id=\"vp_demo\" x=\"0\" y=\"1\" width=\"800\" height=\"700\" projection=\"p\"\n"
      "[projection] id=\"p\" type=\"simple\" screen=\"scr\"\n[what] id=1\n";
  std::string all;
  const auto hall = hallOf(readNdisplayCfg, text, &all);
  ASSERT_TRUE(hall) << all;
  EXPECT_LT((hall->walls[0].wall.lowerLeft - Vec3(-0.5, 2, 1)).norm(), 1e-12);
  EXPECT_EQ(*hall->walls[0].output->place.rectangle, (OutputPlace::Rectangle{5, 7, 800, 700}));
  EXPECT_NE(all.find("5: warning: [screen] odd is not understood"), std::string::npos) << all;
  EXPECT_NE(all.find("9: warning: [what] is not understood"), std::string::npos) << all;
}

}  // namespace
}  // namespace stadion
