/// Pictures of panoramas: each pixel shows its direction, wherever the head is.

#include "engine/maths/angles.h"
#include "engine/maths/functions.h"
#include "engine/maths/srgb.h"
#include "pipeline/projection/hall_pictures.h"
#include "pipeline/view/wall_views.h"

#include <cmath>
#include <gtest/gtest.h>

namespace stadion {
namespace {

/// The sRGB values of a direction: smooth, and no two are alike.
Vec3 valuesOf(const Vec3& direction) {
  return 255 * (0.5 * Vec3::Ones() + 0.4 * direction.normalized());
}

void paintDirections(const PaintedView& view, Picture& picture) {
  const Mat4 rigFromClip = view.clipFromRig.inverse();
  for (std::uint32_t y = 0; y < picture.height; ++y)
    for (std::uint32_t x = 0; x < picture.width; ++x) {
      const Vec4 far =
          rigFromClip * Vec4(2 * (x + 0.5) / picture.width - 1, 1 - 2 * (y + 0.5) / picture.height, 0.5, 1);
      const Vec3 values = valuesOf(far.head<3>() / far.w() - view.eye);
      for (int c = 0; c < 3; ++c) picture.at(x, y)[c] = static_cast<std::uint8_t>(std::lround(values[c]));
    }
}

WallFile hallWith(const std::string& statement) {
  Diagnostics out;
  auto hall = parseWalls(statement + "\n", "t.walls", out);
  EXPECT_TRUE(hall) << (out.all().empty() ? "" : out.all()[0].message);
  return hall ? std::move(*hall) : WallFile{};
}

const Pose kTurnedHead{{0.4, -0.3, 1.5}, det::fromEuler(0.1, 0.2, 0.8)};

TEST(Panorama, PixelsShowTheDirectionsOfTheFormula) {
  for (const char* statement :
       {"panorama p dome-master pixels 200 200",
        "panorama p dome-master pixels 260 200 field-of-view 240 tilt 25 turn 50",
        "panorama p dome-master pixels 200 200 field-of-view 360",
        "panorama p dome-master pixels 100 100 field-of-view 60",
        "panorama p equirectangular pixels 320 160 eye right",
        "panorama p equirectangular pixels 300 120 field-of-view 150 60 tilt -40",
        "panorama p cube pixels 240 160 turn 30", "panorama p cube pixels 96 64 at 1 2 3"}) {
    const WallFile hall = hallWith(statement);
    auto pictures = HallPictures::create(hall);
    ASSERT_TRUE(pictures) << statement << pictures.error().message;
    const std::vector<Picture> shown = pictures.value()->draw(0, kTurnedHead, paintDirections);
    ASSERT_EQ(shown.size(), 1u);
    const Panorama& p = *hall.walls[0].panorama;
    ASSERT_EQ(shown[0].width, p.width);
    ASSERT_EQ(shown[0].height, p.height);
    double worst = 0, sum = 0;
    std::size_t count = 0;
    for (std::uint32_t y = 0; y < p.height; ++y)
      for (std::uint32_t x = 0; x < p.width; ++x) {
        const auto direction = directionAt(p, Vec2((x + 0.5) / p.width, (y + 0.5) / p.height));
        const Vec3 expected = direction ? valuesOf(rotationOf(p) * *direction) : Vec3(0, 0, 0);
        for (int c = 0; c < 3; ++c) {
          const double error = std::abs(shown[0].at(x, y)[c] - expected[c]);
          worst = std::max(worst, error);
          sum += error;
          ++count;
        }
        EXPECT_EQ(shown[0].at(x, y)[3], 255);
      }
    // Both pictures are rounded, and light is averaged between pixels that differ by up to 4 values.
    EXPECT_LE(worst, 1.6) << statement;
    EXPECT_LT(sum / static_cast<double>(count), 0.45) << statement;
  }
}

TEST(Panorama, CubeHasThePixelsOfSixWallsAroundTheHead) {
  const WallFile cube = hallWith("panorama p cube pixels 192 128");
  WallFile walls;
  walls.eyeSeparation = 0;
  const Pose head{{0.4, -0.3, 1.5}, Quat::Identity()};
  for (const CubeSide& side : cubeSides()) {
    const auto corner = [&](double s, double t) -> Vec3 {
      return head.p + 1.5 * (side.normal + s * side.right + t * side.up);
    };
    WallEntry& entry = walls.walls.emplace_back();
    entry.wall = {"side", corner(-1, -1), corner(1, -1), corner(-1, 1)};
    entry.pixels = {64, 64};
  }
  auto ofCube = HallPictures::create(cube), ofWalls = HallPictures::create(walls);
  ASSERT_TRUE(ofCube && ofWalls);
  const Picture shown = ofCube.value()->draw(0, head, paintDirections)[0];
  int most = 0;
  for (std::uint32_t side = 0; side < 6; ++side) {
    const Picture wall = ofWalls.value()->draw(side, head, paintDirections)[0];
    for (std::uint32_t y = 0; y < 64; ++y)
      for (std::uint32_t i = 0; i < 256; ++i)
        most = std::max(most,
                        std::abs(int(shown.at(side % 3 * 64, side / 3 * 64 + y)[i]) - int(wall.at(0, y)[i])));
  }
  EXPECT_LE(most, 1);  // the views are painted with other roundings
}

TEST(Panorama, TakesFewViews) {
  DrawPool pool(1);
  const auto facetsOf = [&](const std::string& statement) {
    auto made = makeProjections(hallWith(statement), pool);
    EXPECT_TRUE(made);
    return made.value()[0]->facets();
  };
  EXPECT_EQ(facetsOf("panorama p equirectangular pixels 400 200").all.size(), 6u);
  EXPECT_EQ(facetsOf("panorama p dome-master pixels 128 128 field-of-view 80").all.size(), 1u);
  // Large pictures are cut in halves so that less is drawn than what five sides have.
  const Facets dome = facetsOf("panorama p dome-master pixels 1024 1024");
  EXPECT_EQ(dome.all.size(), 6u);
  EXPECT_LT(6.0 * dome.width * dome.height, 1.4 * 1024 * 1024);
}

TEST(Panorama, WithTooFewPixelsIsAnError) {
  WallFile hall = hallWith("panorama p dome-master pixels 8 8");
  const auto pictures = HallPictures::create(hall);
  ASSERT_FALSE(pictures);
  EXPECT_EQ(pictures.error().where.line, 1u);
}

TEST(Panorama, ViewsGoWithTheHeadAndStayInPlaceIfTheirPlaceIsStated) {
  DrawPool pool(1);
  for (const bool placed : {false, true}) {
    auto made = makeProjections(
        hallWith(std::string("panorama p equirectangular pixels 400 200") + (placed ? " at 0.5 0.25 2" : "")),
        pool);
    ASSERT_TRUE(made);
    WallViews wall{.name = "p"};
    wall.projection = made.value()[0];
    wall.views = viewsOf(*wall.projection, true);
    ASSERT_EQ(wall.views.size(), 6u);
    wall.reach = {.metres = 0.1, .radians = 0.1};
    const Pose rig{{10, 20, 3}, det::fromEuler(0, 0, 1)};
    ViewerRecord viewer;
    viewer.set(rig, kTurnedHead);
    const PlacedViews views = place(viewer, wall, {});
    const Vec3 eye = rig * (placed ? Vec3(0.5, 0.25, 2) : kTurnedHead.p);
    EXPECT_LT((views.X_WR.p - eye).norm(), 1e-12);
    EXPECT_EQ(views.margin > 0, !placed);
    // Whatever a moved eye sees is in the volume.
    for (std::uint32_t v = 0; v < views.count; ++v) {
      const ConvexVolume seen = views.volume(v, views.endOfScreen(v));
      for (const Vec3& moved : {Vec3(0, 0, 0), Vec3(0.05, -0.05, 0.05), Vec3(-0.09, 0, 0)})
        for (const double far : {0.2, 1.0, 50.0}) {
          const Vec3 p = eye + (placed ? Vec3(0, 0, 0) : moved) +
                         far * (rig.q * Vec3(0.98 * wall.views[v].screen.centre()));
          EXPECT_TRUE(seen.contains(p - views.origin)) << v << " " << far;
        }
    }
  }
}

}  // namespace
}  // namespace stadion
