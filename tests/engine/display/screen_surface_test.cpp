#include "engine/display/lens_turn.h"
#include "engine/display/screen_surface.h"
#include "engine/maths/angles.h"
#include "engine/maths/functions.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace stadion {
namespace {

Screen planeScreen() {
  return {"s", Wall{"s", Vec3(-2, 3, 0), Vec3(2, 3, 0), Vec3(-2, 3, 2)}, 0, 0, {}};
}

Projector lensAt(const Vec3& at, double yaw, double throwRatio) {
  Projector p;
  p.width = 200;
  p.height = 100;
  p.image = LensImage{{at, rotationOf({yaw, 0, 0})}, throwRatio, 1, Vec2::Zero()};
  return p;
}

void expectPoint(const std::optional<Vec3>& found, const Vec3& expected) {
  ASSERT_TRUE(found) << expected.transpose();
  EXPECT_LE((*found - expected).norm(), 1e-12) << found->transpose() << " for " << expected.transpose();
}

TEST(ScreenSurface, OfAPlaneIsHitFromBothSidesAndInsideOfItsEdges) {
  const Screen screen = planeScreen();
  expectPoint(hit(screen, Vec3(0, 0, 1), Vec3(0.1, 1, 0)), Vec3(0.3, 3, 1));
  expectPoint(hit(screen, Vec3(0, 6, 1), Vec3(0, -2, 0)), Vec3(0, 3, 1));
  EXPECT_FALSE(hit(screen, Vec3(0, 0, 1), Vec3(0, -1, 0))) << "behind";
  EXPECT_FALSE(hit(screen, Vec3(0, 0, 1), Vec3(1, 0, 0))) << "along the plane";
  EXPECT_FALSE(hit(screen, Vec3(0, 0, 1), Vec3(1, 1, 0))) << "beside";
  expectPoint(hit(screen, Vec3(0, 0, 0), Vec3(2, 3, 0)), Vec3(2, 3, 0));
}

TEST(ScreenSurface, OfACylinderIsHitFromInsideWithinItsLimits) {
  const Screen screen{"s", CylinderScreen{Vec3(0, 0, 1), 2, -kPi / 2, kPi / 2, -0.5, 0.5}, 0, 0, {}};
  expectPoint(hit(screen, Vec3(0, 0, 1), Vec3(0, 1, 0)), Vec3(0, 2, 1));
  expectPoint(hit(screen, Vec3(0, 0, 1), Vec3(1, 1, 0.1)),
              Vec3(std::sqrt(2), std::sqrt(2), 1 + 0.1 * std::sqrt(2)));
  EXPECT_FALSE(hit(screen, Vec3(0, 0, 1), Vec3(0, -1, 0))) << "the open side";
  EXPECT_FALSE(hit(screen, Vec3(0, 0, 1), Vec3(0, 1, 1))) << "above";
  expectPoint(hit(screen, Vec3(0, -5, 1), Vec3(0, 1, 0)), Vec3(0, 2, 1));
  EXPECT_FALSE(hit(screen, Vec3(0, 5, 1), Vec3(0, -1, 0))) << "the back is before the open side";
  EXPECT_FALSE(hit(screen, Vec3(5, 0, 1), Vec3(0, 1, 0))) << "beside";
  EXPECT_FALSE(hit(screen, Vec3(0, 0, 1), Vec3(0, 0, 1))) << "along the axis";
}

TEST(ScreenSurface, OfASphereTiltsForward) {
  SphereScreen dome{Vec3(0, 0, 0), 3, -kPi, kPi, 0, kPi / 2, 0};
  expectPoint(hit({"s", dome, 0, 0, {}}, Vec3(0, 0, 0), Vec3(0, 0, 1)), Vec3(0, 0, 3));
  EXPECT_FALSE(hit({"s", dome, 0, 0, {}}, Vec3(0, 0, 0), Vec3(0, 1, -0.1)));
  dome.tilt = 30 * kDegree;
  expectPoint(hit({"s", dome, 0, 0, {}}, Vec3(0, 0, 0), Vec3(0, 1, -0.5)), 3 * Vec3(0, 1, -0.5).normalized());
  EXPECT_FALSE(hit({"s", dome, 0, 0, {}}, Vec3(0, 0, 0), Vec3(0, -1, 0.5)))
      << "the rim behind rose by 30 degrees";
  dome.lowest = 89 * kDegree;
  expectPoint(hit({"s", dome, 0, 0, {}}, Vec3(0, 0, 0), Vec3(0, 0.5, std::sqrt(0.75))),
              Vec3(0, 1.5, 3 * std::sqrt(0.75)));
}

TEST(ScreenSurface, OfAMeshIsHitWhereTheNearestOfAllTrianglesIs) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> any(-1, 1);
  const auto point = [&] { return Vec3(any(random), any(random), any(random)); };
  MeshScreen mesh;
  for (std::uint32_t i = 0; i < 300; ++i) {
    const Vec3 at = point();
    for (int k = 0; k < 3; ++k) mesh.points.push_back(at + 0.2 * point());
    mesh.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  const Screen whole{"s", mesh, 0, 0, {}};
  const ScreenSurface surface(whole);
  std::vector<Screen> single;
  for (const auto& t : mesh.triangles) single.push_back({"s", MeshScreen{"", mesh.points, {t}}, 0, 0, {}});
  int hits = 0;
  for (int i = 0; i < 200; ++i) {
    const Vec3 origin = 2 * point(), direction = point();
    double nearest = HUGE_VAL;
    for (const Screen& s : single)
      if (const auto p = hit(s, origin, direction)) nearest = std::min(nearest, (*p - origin).norm());
    const auto found = surface.hit(origin, direction);
    ASSERT_EQ(found.has_value(), nearest < HUGE_VAL);
    if (!found) continue;
    ++hits;
    EXPECT_NEAR((*found - origin).norm(), nearest, 1e-12);
  }
  EXPECT_GT(hits, 20);
}

TEST(ScreenSurface, OfAMeshHasNoCracks) {
  // A sheet of 20 x 20 squares, hit exactly on its inner edges and corners.
  MeshScreen mesh;
  for (int row = 0; row <= 20; ++row)
    for (int column = 0; column <= 20; ++column) mesh.points.emplace_back(column * 0.1, 1, row * 0.1);
  for (std::uint32_t row = 0; row < 20; ++row)
    for (std::uint32_t column = 0; column < 20; ++column) {
      const std::uint32_t a = row * 21 + column;
      mesh.triangles.push_back({a, a + 1, a + 21});
      mesh.triangles.push_back({a + 1, a + 22, a + 21});
    }
  const Screen screen{"s", mesh, 0, 0, {}};
  const ScreenSurface surface(screen);
  for (int row = 0; row <= 40; ++row)
    for (int column = 0; column <= 40; ++column)
      EXPECT_TRUE(surface.hit(Vec3(0.3, -1, 0.7), Vec3(column * 0.05, 1, row * 0.05) - Vec3(0.3, -1, 0.7)));
}

TEST(PixelRays, OfALensFollowTheThrowRatio) {
  const Screen screen = planeScreen();
  Projector p = lensAt(Vec3(0, 0, 1), 0, 1);
  expectPoint(pointLit(p, screen, Vec2(0.5, 0.5)), Vec3(0, 3, 1));
  expectPoint(pointLit(p, screen, Vec2(0, 0)), Vec3(-1.5, 3, 1.75));
  expectPoint(pointLit(p, screen, Vec2(1, 1)), Vec3(1.5, 3, 0.25));
  std::get<LensImage>(p.image).shift = Vec2(0.1, 0.5);
  expectPoint(pointLit(p, screen, Vec2(0.5, 1)), Vec3(0.3, 3, 1));
  std::get<LensImage>(p.image).throwRatio = 0.5;
  EXPECT_FALSE(pointLit(p, screen, Vec2(0, 0.5)));
}

TEST(PixelRays, FromBehindAreMirrored) {
  expectPoint(pointLit(lensAt(Vec3(0, 6, 1), kPi, 1), planeScreen(), Vec2(0, 0)), Vec3(1.5, 3, 1.75));
}

TEST(PixelRays, OfAFisheyeGrowWithTheAngleAndEndAtTheCircle) {
  const Screen dome{"s", SphereScreen{Vec3::Zero(), 3, -kPi, kPi, -kPi / 2, kPi / 2, 0}, 0, 0, {}};
  Projector p;
  p.width = 200;
  p.height = 100;
  p.image = FisheyeImage{{}, kPi};
  expectPoint(pointLit(p, dome, Vec2(0.5, 0.5)), Vec3(0, 3, 0));
  expectPoint(pointLit(p, dome, Vec2(0.75, 0.5)), Vec3(3, 0, 0));
  expectPoint(pointLit(p, dome, Vec2(0.5, 0)), Vec3(0, 0, 3));
  expectPoint(pointLit(p, dome, Vec2(0.5, 0.25)), 3 * Vec3(0, std::sqrt(0.5), std::sqrt(0.5)));
  EXPECT_FALSE(pointLit(p, dome, Vec2(0.76, 0.5)));
  EXPECT_FALSE(pointLit(p, dome, Vec2(0, 0)));
}

TEST(PixelRays, OfCornerPinsKeepTheCornersAndLines) {
  Projector p;
  p.width = 200;
  p.height = 100;
  p.image = PinnedImage{{Vec2(0.1, 0.1), Vec2(0.9, 0), Vec2(1, 1), Vec2(0, 0.8)}};
  const Screen screen = planeScreen();
  expectPoint(pointLit(p, screen, Vec2(0.1, 0.1)), Vec3(-2, 3, 2));
  expectPoint(pointLit(p, screen, Vec2(0.9, 0)), Vec3(2, 3, 2));
  expectPoint(pointLit(p, screen, Vec2(1, 1)), Vec3(2, 3, 0));
  expectPoint(pointLit(p, screen, Vec2(0, 0.8)), Vec3(-2, 3, 0));
  EXPECT_FALSE(pointLit(p, screen, Vec2(0, 0)));
  // Diagonals stay lines: they meet in the middle of the screen.
  expectPoint(pointLit(p, screen, Vec2(7.2 / 17, 7.2 / 17)), Vec3(0, 3, 1));
  p.image = PinnedImage{{Vec2(0, 0), Vec2(1, 0), Vec2(1, 1), Vec2(0, 1)}};
  expectPoint(pointLit(p, screen, Vec2(0.25, 0.75)), Vec3(-1, 3, 0.5));
}

TEST(PixelRays, OfAMeasuredImageInterpolateAndReachTheEdge) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  Projector p;
  p.width = 200;
  p.height = 100;
  MeasuredImage image;
  image.columns = 3;
  image.rows = 2;
  for (int row = 0; row < 2; ++row)
    for (int column = 0; column < 3; ++column) image.points.emplace_back(column, 3, 1 - row);
  p.image = image;
  const Screen screen = planeScreen();
  expectPoint(pointLit(p, screen, Vec2(0.5, 0.5)), Vec3(1, 3, 0.5));
  expectPoint(pointLit(p, screen, Vec2(0, 0)), Vec3(-0.5, 3, 1.5));
  expectPoint(pointLit(p, screen, Vec2(1, 1)), Vec3(2.5, 3, -0.5));
  image.points[2] = Vec3(nan, 0, 0);
  p.image = image;
  EXPECT_FALSE(pointLit(p, screen, Vec2(0.9, 0.5)));
  EXPECT_TRUE(pointLit(p, screen, Vec2(0.2, 0.5)));
}

}  // namespace
}  // namespace stadion
