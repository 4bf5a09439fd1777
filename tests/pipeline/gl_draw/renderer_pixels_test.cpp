// Pictures of scenes simple enough to know every pixel.
#include "engine/maths/srgb.h"
#include "tests/pipeline/gl_draw/renderer_scene.h"

#include <gtest/gtest.h>

#include <cmath>

namespace stadion {
namespace {

using test::matt;
using test::MeshMaker;
using test::place;
using test::Stage;

constexpr std::uint32_t kSide = 64;

::testing::AssertionResult shows(const std::uint8_t* pixel, int r, int g, int b, int tolerance = 1) {
  if (std::abs(pixel[0] - r) <= tolerance && std::abs(pixel[1] - g) <= tolerance &&
      std::abs(pixel[2] - b) <= tolerance && pixel[3] == 255)
    return ::testing::AssertionSuccess();
  return ::testing::AssertionFailure() << int(pixel[0]) << " " << int(pixel[1]) << " " << int(pixel[2]) << " "
                                       << int(pixel[3]) << " instead of " << r << " " << g << " " << b;
}

/// A rectangle in the plane at depth y, seen square on by the orthographic eye.
std::unique_ptr<Mesh> sheet(Material material, double x0, double x1, double z0, double z1, double y = 0) {
  return MeshMaker(std::move(material)).quad({x0, y, z0}, {x1, y, z0}, {x1, y, z1}, {x0, y, z1}).seal();
}

TEST(PicturePixels, AFaceInAmbientLightAloneHasItsOwnColour) {
  MeshStore meshes;
  DrawList list = test::plainList();
  list.opaque = {place(meshes.add(sheet(matt(0.5f, 0.2f, 0.05f), -2, 2, -2, 2)))};
  const auto picture = Stage(meshes, kSide, kSide).draw(list);
  for (const auto at : {0u, kSide / 2, kSide - 1})
    EXPECT_TRUE(shows(picture.at(at, at), test::sRgb(0.5), test::sRgb(0.2), test::sRgb(0.05)));
}

TEST(PicturePixels, AnEmissiveFaceNeedsNoLight) {
  MeshStore meshes;
  DrawList list = test::plainList();
  list.sky.ambient = {0, 0, 0};
  Material lit = matt(0, 0, 0);
  lit.emissive = {0.25f, 0.5f, 0.75f};
  list.opaque = {place(meshes.add(sheet(lit, -2, 2, -2, 2)))};
  EXPECT_TRUE(shows(Stage(meshes, kSide, kSide).draw(list).at(9, 9), test::sRgb(0.25), test::sRgb(0.5),
                    test::sRgb(0.75)));
}

TEST(PicturePixels, ASlantedLightFollowsTheCosine) {
  MeshStore meshes;
  DrawList list = test::plainList();
  list.sky.ambient = {0, 0, 0};
  DrawLight light;
  light.direction = {0.8f, 0.6f, 0};  // on to the sheet at a cosine of 0.6
  list.lights = {light};
  list.opaque = {place(meshes.add(sheet(matt(0.5f, 0.5f, 0.5f), -2, 2, -2, 2)))};
  const int expected = test::sRgb(0.3);
  EXPECT_TRUE(shows(Stage(meshes, kSide, kSide).draw(list).at(32, 32), expected, expected, expected, 3));
}

TEST(PicturePixels, ATriangleCoversItsPixelsAndHalfCoversItsEdge) {
  MeshStore meshes;
  DrawList list = test::plainList();
  list.sky.horizon = list.sky.zenith = list.sky.ground = {0, 0, 0};
  Material white = matt(0, 0, 0);
  white.emissive = {0.8f, 0.8f, 0.8f};
  list.opaque = {place(meshes.add(MeshMaker(white).triangle({-1, 0, -1}, {1, 0, -1}, {-1, 0, 1}).seal()))};
  const auto picture = Stage(meshes, kSide, kSide).draw(list);
  const int full = test::sRgb(0.8);
  for (std::uint32_t y = 0; y < kSide; ++y)
    for (std::uint32_t x = 0; x < kSide; ++x) {
      if (x + 1 >= y && x <= y + 1) continue;
      const int expected = x < y ? full : 0;
      EXPECT_TRUE(shows(picture.at(x, y), expected, expected, expected)) << x << " " << y;
    }
  // Two of the four samples lie inside: half the light, not half the number.
  const int half = test::sRgb(0.4);
  EXPECT_TRUE(shows(picture.at(30, 30), half, half, half, 2));
}

TEST(PicturePixels, RowsRunFromTheTop) {
  MeshStore meshes;
  DrawList list = test::plainList();
  list.opaque = {place(meshes.add(sheet(matt(0.7f, 0, 0), -1, 1, 0, 1))),
                 place(meshes.add(sheet(matt(0, 0.7f, 0), -1, 1, -1, 0)))};
  const auto picture = Stage(meshes, 33, 17).draw(list);
  EXPECT_GT(picture.at(16, 0)[0], picture.at(16, 0)[1]);
  EXPECT_LT(picture.at(16, 16)[0], picture.at(16, 16)[1]);
}

TEST(PicturePixels, TexturesStandUprightInSrgb) {
  Texture texture{32, 32, {}, "four quarters: red, green, blue, grey"};
  for (int i = 0; i < 32 * 32; ++i) {
    const bool low = i >= 32 * 16, right = i % 32 >= 16;
    const int r = low ? 128 * right : 255 * !right, g = low ? 128 * right : 255 * right,
              b = low ? 255 - 127 * right : 0;
    for (const int c : {r, g, b, 255}) texture.rgba.push_back(static_cast<std::uint8_t>(c));
  }
  MeshStore meshes;
  DrawList list = test::plainList();
  list.sky.ambient = {0.7f, 0.7f, 0.7f};
  MeshMaker maker(matt(1, 1, 1));
  maker.texture(texture).quad({-1, 0, -1}, {1, 0, -1}, {1, 0, 1}, {-1, 0, 1});
  list.opaque = {place(meshes.add(maker.seal()))};
  const auto picture = Stage(meshes, kSide, kSide).draw(list);
  const int bright = test::sRgb(0.7), grey = test::sRgb(0.7 * 0.215861);
  EXPECT_TRUE(shows(picture.at(8, 8), bright, 0, 0, 2));
  EXPECT_TRUE(shows(picture.at(55, 8), 0, bright, 0, 2));
  EXPECT_TRUE(shows(picture.at(8, 55), 0, 0, bright, 2));
  EXPECT_TRUE(shows(picture.at(55, 55), grey, grey, grey, 2));
}

TEST(PicturePixels, VertexColoursMultiplyTheMaterial) {
  MeshStore meshes;
  DrawList list = test::plainList();
  auto mesh = sheet(matt(0.5f, 0.5f, 0.5f), -2, 2, -2, 2);
  mesh->colours.assign(4, {255, 51, 0, 255});
  list.opaque = {place(meshes.add(std::move(mesh)))};
  const double green = 0.5 * linearFromSrgb(51 / 255.0);
  EXPECT_TRUE(shows(Stage(meshes, kSide, kSide).draw(list).at(5, 5), test::sRgb(0.5), test::sRgb(green), 0));
}

TEST(PicturePixels, TransparentThingsBlendByDepthWhateverTheListsOrder) {
  MeshStore meshes;
  DrawList list = test::plainList();
  const MeshId wall = meshes.add(sheet(matt(0.8f, 0, 0), -2, 2, -2, 2, 5));
  const MeshId far = meshes.add(sheet(matt(0, 0.8f, 0, 0.5f), -2, 2, -2, 2, 2));
  const MeshId near = meshes.add(sheet(matt(0, 0, 0.8f, 0.5f), -2, 2, -2, 2, 1));
  list.opaque = {place(wall)};
  list.transparent = {place(far), place(near)};
  Stage stage(meshes, kSide, kSide);
  EXPECT_TRUE(shows(stage.draw(list).at(20, 20), test::sRgb(0.2), test::sRgb(0.2), test::sRgb(0.4), 2));
  std::swap(list.transparent[0], list.transparent[1]);
  EXPECT_TRUE(shows(stage.draw(list).at(20, 20), test::sRgb(0.2), test::sRgb(0.2), test::sRgb(0.4), 2));
}

TEST(PicturePixels, NothingTransparentShowsThroughWhatStandsBeforeIt) {
  MeshStore meshes;
  DrawList list = test::plainList();
  list.opaque = {place(meshes.add(sheet(matt(0.8f, 0, 0), -2, 2, -2, 2, 0)))};
  list.transparent = {place(meshes.add(sheet(matt(0, 0, 0.8f, 0.5f), -2, 2, -2, 2, 3)))};
  EXPECT_TRUE(shows(Stage(meshes, kSide, kSide).draw(list).at(20, 20), test::sRgb(0.8), 0, 0));
}

TEST(PicturePixels, TheOpaquePartsOfATransparentThingHideWhatIsBehind) {
  MeshStore meshes;
  DrawList list = test::plainList();
  auto mesh = MeshMaker(matt(0.8f, 0, 0))
                  .quad({-1, 0, -1}, {0, 0, -1}, {0, 0, 1}, {-1, 0, 1})
                  .quad({0, 0, -1}, {1, 0, -1}, {1, 0, 1}, {0, 0, 1})
                  .seal();
  mesh->materials.push_back(matt(0, 0, 0.8f, 0.5f));
  mesh->submeshes = {{0, 6, 0}, {6, 6, 1}};
  const MeshId window = meshes.add(std::move(mesh));
  const MeshId behind = meshes.add(sheet(matt(0, 0.8f, 0, 0.5f), -2, 2, -2, 2, 3));
  list.sky.horizon = list.sky.zenith = {0, 0, 0};
  list.transparent = {place(behind), place(window)};
  const auto picture = Stage(meshes, kSide, kSide).draw(list);
  EXPECT_TRUE(shows(picture.at(10, 30), test::sRgb(0.8), 0, 0));
  EXPECT_GT(picture.at(50, 30)[2], 90);
  EXPECT_GT(picture.at(50, 30)[1], 30);
}

TEST(PicturePixels, HazeTakesItsShareByDistance) {
  MeshStore meshes;
  DrawList list = test::plainList();
  list.sky.horizon = {0, 0, 0.6f};
  list.sky.hazeDistance = 10;  // the eye is 10 m before the sheet's middle
  list.opaque = {place(meshes.add(sheet(matt(0.5f, 0, 0), -2, 2, -2, 2)))};
  const double kept = std::exp(-1.0);
  EXPECT_TRUE(shows(Stage(meshes, kSide, kSide).draw(list).at(32, 32), test::sRgb(0.5 * kept), 0,
                    test::sRgb(0.6 * (1 - kept)), 2));
}

TEST(PicturePixels, TheSkyFillsWhatIsLeft) {
  MeshStore meshes;
  DrawList list;
  list.viewCount = 1;
  list.views[0] = test::lookAt(Vec3(0, 0, 1.7), Vec3(0, 10, 1.7), 1.2, 1);
  list.sky.zenith = {0, 0, 0.5f};
  list.sky.horizon = {0.5f, 0, 0};
  list.sky.ground = {0, 0.5f, 0};
  const auto picture = Stage(meshes, kSide, kSide).draw(list);
  EXPECT_GT(picture.at(32, 0)[2], picture.at(32, 31)[2]);
  EXPECT_GT(picture.at(32, 31)[0], picture.at(32, 0)[0]);
  EXPECT_GT(picture.at(32, 63)[1], picture.at(32, 63)[0]);
}

TEST(PicturePixels, TheSunStandsWhereItsLightComesFrom) {
  MeshStore meshes;
  DrawList list;
  list.viewCount = 1;
  list.views[0] = test::lookAt(Vec3::Zero(), Vec3(0, 1, 0.5), 0.5, 1);
  DrawLight sun;
  const float s = std::sqrt(1.25f);
  sun.direction = {0, -1 / s, -0.5f / s};
  list.lights = {sun};
  const auto picture = Stage(meshes, 101, 101).draw(list);
  EXPECT_GT(picture.at(50, 50)[0], 245);
  EXPECT_LT(picture.at(5, 50)[0], 200);
}

TEST(PicturePixels, NormalsSurviveAStretch) {
  // A sphere squashed to a hundredth along y is a disc: seen along y nearly all of it faces the eye.
  MeshStore meshes;
  DrawList list = test::plainList();
  list.sky.ambient = {0, 0, 0};
  DrawLight light;
  light.direction = {0, 1, 0};
  list.lights = {light};
  Affine squashed = Affine::Identity();
  squashed.linear() = Vec3(1, 0.01, 1).asDiagonal();
  list.opaque = {place(meshes.add(MeshMaker(matt(0.5f, 0.5f, 0.5f)).sphere(1, 32).seal()), squashed)};
  const int expected = test::sRgb(0.5);
  EXPECT_TRUE(shows(Stage(meshes, kSide, kSide).draw(list).at(52, 32), expected, expected, expected, 3));
}

TEST(PicturePixels, AMirroredBoxLooksLikeTheBox) {
  MeshStore meshes;
  DrawList list;
  list.viewCount = 1;
  list.views[0] = test::lookAt(Vec3(2, -3, 2), Vec3::Zero(), 0.8, 1);
  DrawLight light;
  light.direction = {-0.6f, 0.64f, -0.48f};
  list.lights = {light};
  const MeshId box =
      meshes.add(MeshMaker(matt(0.6f, 0.5f, 0.4f)).box({-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}).seal());
  list.opaque = {place(box)};
  Stage stage(meshes, kSide, kSide);
  const auto straight = stage.draw(list);
  Affine mirror = Affine::Identity();
  mirror.linear() = Vec3(-1, 1, 1).asDiagonal();
  list.opaque = {place(box, mirror)};
  const auto mirrored = stage.draw(list);
  // The triangles of a face are split along the other diagonal: a few edge samples may differ, no face does.
  std::size_t different = 0;
  for (std::size_t i = 0; i < straight.rgba.size(); i += 4)
    different += std::abs(straight.rgba[i] - mirrored.rgba[i]) > 3;
  EXPECT_LT(different, 40u);
  test::writePng(mirrored, "mirrored-box");
}

TEST(PicturePixels, AnOpenSheetIsSeenFromBehindAndLitOnThatSide) {
  MeshStore meshes;
  DrawList list = test::plainList();
  list.sky.ambient = {0, 0, 0};
  DrawLight light;
  light.direction = {0, 1, 0};
  list.lights = {light};
  auto behind = MeshMaker(matt(0.5f, 0.5f, 0.5f)).quad({1, 0, -1}, {-1, 0, -1}, {-1, 0, 1}, {1, 0, 1}).seal();
  list.opaque = {place(meshes.add(std::move(behind)))};
  const int expected = test::sRgb(0.5);
  EXPECT_TRUE(shows(Stage(meshes, kSide, kSide).draw(list).at(32, 32), expected, expected, expected, 3));
}

TEST(PicturePixels, ALampFadesToNothingAtItsRange) {
  MeshStore meshes;
  DrawList list = test::plainList();
  list.sky.ambient = {0, 0, 0};
  DrawLight lamp;
  lamp.kind = DrawLight::Kind::Point;
  lamp.position = {-1, -0.5f, 0};
  lamp.range = 1.5f;
  list.lights = {lamp};
  list.opaque = {place(meshes.add(sheet(matt(0.8f, 0.8f, 0.8f), -2, 2, -2, 2)))};
  const auto picture = Stage(meshes, kSide, kSide).draw(list);
  EXPECT_GT(picture.at(1, 32)[0], 150);
  EXPECT_TRUE(shows(picture.at(60, 32), 0, 0, 0, 0));
}

TEST(PicturePixels, ALampThatFallsOffIsAQuarterAsBrightAtTwiceTheDistance) {
  const auto brightness = [](float distance) {
    MeshStore meshes;
    DrawList list = test::plainList();
    list.sky.ambient = {0, 0, 0};
    DrawLight lamp;
    lamp.kind = DrawLight::Kind::Point;
    lamp.position = {0, -distance, 0};
    lamp.colour = {2, 2, 2};
    lamp.fallsOff = true;
    list.lights = {lamp};
    list.opaque = {place(meshes.add(sheet(matt(0.8f, 0.8f, 0.8f), -2, 2, -2, 2)))};
    return linearFromSrgb(Stage(meshes, kSide, kSide).draw(list).at(32, 32)[0] / 255.0);
  };
  EXPECT_NEAR(brightness(4) / brightness(2), 0.25, 0.03);
}

TEST(PicturePixels, ASpotLightsItsConeOnly) {
  MeshStore meshes;
  DrawList list = test::plainList();
  list.sky.ambient = {0, 0, 0};
  DrawLight spot;
  spot.kind = DrawLight::Kind::Spot;
  spot.position = {0, -2, 0};
  spot.direction = {0, 1, 0};
  spot.cosInner = spot.cosOuter = 0.97f;  // 14 degrees: half a metre on the sheet
  list.lights = {spot};
  list.opaque = {place(meshes.add(sheet(matt(0.8f, 0.8f, 0.8f), -2, 2, -2, 2)))};
  const auto picture = Stage(meshes, kSide, kSide).draw(list);
  EXPECT_GT(picture.at(32, 32)[0], 200);
  EXPECT_TRUE(shows(picture.at(52, 32), 0, 0, 0, 0));
}

}  // namespace
}  // namespace stadion
