/// Panoramas: which direction each place of a picture shows, and how wall files state them.

#include "engine/panorama/panorama.h"

#include "engine/display/unfolding.h"
#include "engine/display/wall_lint.h"
#include "engine/maths/angles.h"
#include "engine/maths/functions.h"

#include <cmath>
#include <gtest/gtest.h>

namespace stadion {
namespace {

Panorama panoramaOf(PanoramaKind kind, double across, double upright, std::uint32_t width,
                    std::uint32_t height) {
  Panorama p;
  p.kind = kind;
  p.across = across * kDegree;
  p.upright = upright * kDegree;
  p.width = width;
  p.height = height;
  return p;
}

const Panorama kPanoramas[] = {panoramaOf(PanoramaKind::DomeMaster, 180, 0, 400, 400),
                               panoramaOf(PanoramaKind::DomeMaster, 220, 0, 640, 400),
                               panoramaOf(PanoramaKind::DomeMaster, 360, 0, 400, 500),
                               panoramaOf(PanoramaKind::Equirectangular, 360, 180, 400, 200),
                               panoramaOf(PanoramaKind::Equirectangular, 120, 50, 300, 200),
                               panoramaOf(PanoramaKind::Cube, 0, 0, 480, 320)};

TEST(Panorama, DirectionsOfPixelsLeadBackToTheirPixels) {
  for (const Panorama& p : kPanoramas) {
    std::size_t shown = 0;
    for (std::uint32_t y = 0; y < p.height; y += 7)
      for (std::uint32_t x = 0; x < p.width; x += 5) {
        const Vec2 share((x + 0.5) / p.width, (y + 0.5) / p.height);
        const auto direction = directionAt(p, share);
        if (!direction) continue;
        ++shown;
        const auto back = shareOf(p, *direction);
        ASSERT_TRUE(back) << panoramaKindName(p.kind) << share.transpose();
        EXPECT_LT((*back - share).norm(), 1e-12) << panoramaKindName(p.kind) << share.transpose();
      }
    EXPECT_GT(shown, 1000u);
  }
}

TEST(Panorama, DomeMasterHasTheZenithInItsMiddleAndTheFrontBelow) {
  Panorama p = kPanoramas[0];
  const auto seenAt = [&](double u, double v) -> Vec3 {
    return rotationOf(p) * directionAt(p, Vec2(u, v))->normalized();
  };
  EXPECT_LT((seenAt(0.5, 0.5) - Vec3(0, 0, 1)).norm(), 1e-12);
  EXPECT_LT((seenAt(0.5, 1) - Vec3(0, 1, 0)).norm(), 1e-12);
  EXPECT_LT((seenAt(1, 0.5) - Vec3(1, 0, 0)).norm(), 1e-12);
  EXPECT_LT((seenAt(0.5, 0.75) - Vec3(0, std::sqrt(0.5), std::sqrt(0.5))).norm(), 1e-12);
  EXPECT_FALSE(directionAt(p, Vec2(0.1, 0.1))) << "outside of the circle";
  p.tilt = 30 * kDegree;  // what is overhead comes forward
  EXPECT_LT((seenAt(0.5, 0.5) - Vec3(0, 0.5, std::sqrt(0.75))).norm(), 1e-12);
  p.turn = 90 * kDegree;
  EXPECT_LT((seenAt(0.5, 0.5) - Vec3(0.5, 0, std::sqrt(0.75))).norm(), 1e-12);
}

TEST(Panorama, EquirectangularHasEvenStepsOfAzimuthAndElevation) {
  const Panorama& p = kPanoramas[3];
  for (int azimuth = -170; azimuth <= 170; azimuth += 34)
    for (int elevation = -80; elevation <= 80; elevation += 20) {
      const double a = azimuth * kDegree, e = elevation * kDegree;
      const Vec3 d = *directionAt(p, Vec2(0.5 + azimuth / 360.0, 0.5 - elevation / 180.0));
      EXPECT_LT((d - Vec3(std::cos(e) * std::sin(a), std::cos(e) * std::cos(a), std::sin(e))).norm(), 1e-12);
    }
  EXPECT_FALSE(shareOf(kPanoramas[4], Vec3(0, -1, 0))) << "behind";
}

TEST(Panorama, SidesOfACubeMeetWithoutAGap) {
  const Panorama& p = kPanoramas[5];
  // The right edge of the front and the left edge of the right side; the lower edge of up and the upper of front.
  for (double t : {0.01, 0.3, 0.77}) {
    const Vec3 front = *directionAt(p, Vec2(1 - 1.0 / 3 - 1e-9, 0.5 + 0.5 * t)),
               right = *directionAt(p, Vec2(0, 0.5 * t));
    EXPECT_LT((front - right).norm(), 1e-7);
    const Vec3 up = *directionAt(p, Vec2((2 + t) / 3, 0.5 - 1e-9)),
               below = *directionAt(p, Vec2((1 + t) / 3, 0.5));
    EXPECT_LT((up - below).norm(), 1e-7);
  }
}

std::string findingsAbout(const std::string& text, std::optional<WallFile>& hall) {
  Diagnostics out;
  hall = parseWalls(text, "t.walls", out);
  if (hall) lintWalls(*hall, out);
  std::string all;
  for (const Diagnostic& d : out.all())
    all += std::to_string(d.where.line) + ":" + std::to_string(d.where.column) + ": " + d.message + "\n";
  return all;
}

TEST(Panorama, IsStatedInAWallFileAndWrittenBack) {
  std::optional<WallFile> hall;
  EXPECT_EQ(findingsAbout(
                "unit cm\npixels 960 640\n"
                "panorama dome dome-master pixels 1024 1024 field-of-view 200 tilt 15 turn -20 eye right\n"
                "panorama sphere equirectangular field-of-view 300 90 at 10 20 170\n"
                "panorama box cube card 1\n",
                hall),
            "");
  ASSERT_TRUE(hall);
  const Panorama &dome = *hall->walls[0].panorama, &sphere = *hall->walls[1].panorama;
  EXPECT_NEAR(dome.across, 200 * kDegree, 1e-12);
  EXPECT_NEAR(dome.tilt, 15 * kDegree, 1e-12);
  EXPECT_EQ(dome.eye, PanoramaEye::Right);
  EXPECT_EQ(*sphere.at, Vec3(0.1, 0.2, 1.7));
  EXPECT_NEAR(sphere.upright, 90 * kDegree, 1e-12);
  EXPECT_EQ(sphere.width, 960u);
  std::optional<WallFile> again;
  const std::string text = formatWalls(*hall);
  EXPECT_EQ(findingsAbout(text, again), "");
  ASSERT_TRUE(again);
  EXPECT_EQ(formatWalls(*again), text);
  EXPECT_EQ(unfold(hall->walls, 640, 480).size(), 3u);
  const std::string plan = floorPlan(*hall);
  EXPECT_NE(
      plan.find("dome         shows 200 degrees as a dome master, 1024 x 1024 pixels, from the right eye"),
      std::string::npos)
      << plan;
  EXPECT_NE(plan.find("shows 300 x 90 degrees equirectangularly, 960 x 640 pixels, from 0.10 0.20 1.70"),
            std::string::npos)
      << plan;
}

TEST(Panorama, NeedsASizeThatFitsItsKind) {
  std::optional<WallFile> hall;
  EXPECT_EQ(findingsAbout("panorama a dome-master\n", hall),
            "1:10: panorama \"a\" has no size; add: pixels WIDTH HEIGHT, here or as a line for all\n");
  EXPECT_NE(findingsAbout("panorama a cube pixels 800 600\n", hall).find("write: pixels 792 528"),
            std::string::npos);
}

TEST(Panorama, KeepsItsShapeAtAnotherWidth) {
  EXPECT_EQ(withWidth(kPanoramas[3], 200).height, 100u);
  const Panorama cube = withWidth(kPanoramas[5], 100);
  EXPECT_EQ(cube.width, 96u);
  EXPECT_TRUE(sizeFits(cube));
}

}  // namespace
}  // namespace stadion
