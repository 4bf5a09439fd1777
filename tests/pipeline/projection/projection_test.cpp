/// Pictures of projectors: where each pixel's colour comes from, and how much light it gives.

#include "engine/maths/angles.h"
#include "engine/maths/functions.h"
#include "engine/maths/srgb.h"
#include "pipeline/projection/hall_pictures.h"
#include "tests/pipeline/projection/round_hall.h"

#include <cmath>
#include <gtest/gtest.h>

namespace stadion {
namespace {

using test::roundHall;

Pose headAt(const Vec3& p) {
  return {p, Quat::Identity()};
}

/// Paints by direction from the eye: light(direction) from 0 to 1 by channel.
HallPictures::Painter byDirection(const std::function<Vec3(const Vec3&)>& light) {
  return [light](const PaintedView& view, Picture& picture) {
    const Mat4 rigFromClip = view.clipFromRig.inverse();
    for (std::uint32_t y = 0; y < picture.height; ++y)
      for (std::uint32_t x = 0; x < picture.width; ++x) {
        const Vec4 far =
            rigFromClip * Vec4(2 * (x + 0.5) / picture.width - 1, 1 - 2 * (y + 0.5) / picture.height, 0.5, 1);
        const Vec3 shown = light((far.head<3>() / far.w() - view.eye).normalized());
        for (int c = 0; c < 3; ++c)
          picture.at(x, y)[c] = static_cast<std::uint8_t>(std::lround(255 * srgbFromLinear(shown[c])));
      }
  };
}

Vec3 grey(double light) {
  return Vec3::Constant(light);
}

/// The green light at a place [pixels], between pixels' centres.
double lightAt(const Picture& picture, double x, double y) {
  const double u = std::clamp(x - 0.5, 0.0, picture.width - 1.001),
               v = std::clamp(y - 0.5, 0.0, picture.height - 1.001);
  const auto column = static_cast<std::uint32_t>(u), row = static_cast<std::uint32_t>(v);
  const auto at = [&](std::uint32_t c, std::uint32_t r) {
    return linearFromSrgb(picture.at(c, r)[1] / 255.0);
  };
  const double s = u - column, t = v - row;
  return (1 - t) * ((1 - s) * at(column, row) + s * at(column + 1, row)) +
         t * ((1 - s) * at(column, row + 1) + s * at(column + 1, row + 1));
}

double lightOf(std::uint8_t value) {
  return linearFromSrgb(value / 255.0);
}

TEST(Projection, PixelsShowWhatLiesBehindTheirPointForTheEye) {
  const WallFile hall = roundHall(3, 90 * kDegree, 0.15);
  auto pictures = HallPictures::create(hall);
  ASSERT_TRUE(pictures) << pictures.error().message;
  const Pose head = headAt({0.2, -0.1, 1.6});
  const auto paint = byDirection(
      [](const Vec3& d) { return Vec3(0.5 + 0.4 * d.x(), 0.5 + 0.4 * d.y(), 0.5 + 0.4 * d.z()); });
  const Screen& screen = hall.screens[0];
  double worst = 0;
  for (std::size_t entry = 0; entry < 3; ++entry) {
    const std::vector<Picture> shown = pictures.value()->draw(entry, head, paint);
    ASSERT_EQ(shown.size(), 2U);
    const Projector& p = *hall.walls[entry].projector;
    ASSERT_EQ(shown[1].width, p.width);
    const Vec3 eye = eyePosition(head, Eye::Right, hall.eyeSeparation);
    for (std::uint32_t y = 3; y < p.height; y += 7)
      for (std::uint32_t x = 3; x < p.width; x += 11) {
        const auto point = pointLit(p, screen, Vec2((x + 0.5) / p.width, (y + 0.5) / p.height));
        if (!point) continue;
        const Vec3 d = (*point - eye).normalized();
        // Shares of the light are the same in all channels, so ratios are those of the scene.
        const std::uint8_t* at = shown[1].at(x, y);
        const double sum = lightOf(at[0]) + lightOf(at[1]) + lightOf(at[2]);
        if (sum < 0.3) continue;
        const Vec3 expected = grey(0.5) + 0.4 * d;
        for (int c = 0; c < 3; ++c)
          worst = std::max(worst, std::abs(lightOf(at[c]) / sum - expected[c] / expected.sum()));
      }
  }
  EXPECT_LT(worst, 0.012);  // steps of 8 bits
}

TEST(Projection, SharesOfOverlappingProjectorsSumToAll) {
  const WallFile hall = roundHall(4, 120 * kDegree, 0.2);
  auto pictures = HallPictures::create(hall);
  ASSERT_TRUE(pictures) << pictures.error().message;
  const auto paint = byDirection([](const Vec3&) { return grey(0.6); });
  std::vector<Picture> shown;
  for (std::size_t i = 0; i < 4; ++i)
    shown.push_back(pictures.value()->draw(i, headAt({0, 0, 1.6}), paint)[0]);
  const ScreenSurface surface(hall.screens[0]);
  std::vector<std::unique_ptr<ThrownImage>> images;
  for (const WallEntry& e : hall.walls)
    images.push_back(std::make_unique<ThrownImage>(*e.projector, surface));
  std::size_t overlapping = 0;
  for (double azimuth = -118; azimuth < 118; azimuth += 0.37)
    for (double z = 0.8; z < 2.1; z += 0.17) {
      const double a = azimuth * kDegree;
      double sum = 0;
      std::size_t count = 0;
      for (std::size_t i = 0; i < 4; ++i) {
        const auto share = images[i]->shareOf({3 * std::sin(a), 3 * std::cos(a), z});
        if (!share) continue;
        sum += lightAt(shown[i], share->x() * 640, share->y() * 400);
        ++count;
      }
      overlapping += count > 1;
      if (count == 0) continue;
      EXPECT_NEAR(sum, 0.6, 0.012) << azimuth << " " << z << " " << count;
    }
  EXPECT_GT(overlapping, 300U);
}

TEST(Projection, RampsBeginAtTheEdgesThatTheFileStatesAndSharesStillSumToAll) {
  WallFile hall = roundHall(2, 60 * kDegree, 0.3);
  // The ring goes from left to right: the first one's picture overlaps the second one's at its right border.
  hall.walls[0].projector->blend.edges = {0, 0.1, 0, 0};
  hall.walls[1].projector->blend.edges = {0.05, 0, 0, 0};
  auto pictures = HallPictures::create(hall);
  ASSERT_TRUE(pictures) << pictures.error().message;
  const auto paint = byDirection([](const Vec3&) { return grey(0.6); });
  std::vector<Picture> shown;
  for (std::size_t i = 0; i < 2; ++i)
    shown.push_back(pictures.value()->draw(i, headAt({0, 0, 1.6}), paint)[0]);
  const ScreenSurface surface(hall.screens[0]);
  const ThrownImage left(*hall.walls[0].projector, surface), right(*hall.walls[1].projector, surface);
  std::size_t beyond = 0, overlapping = 0;
  for (double azimuth = -50; azimuth < 50; azimuth += 0.23) {
    const double a = azimuth * kDegree;
    const Vec3 point(3 * std::sin(a), 3 * std::cos(a), 1.4);
    const auto one = left.shareOf(point), two = right.shareOf(point);
    if (!one || !two) continue;
    const double light = lightAt(shown[0], one->x() * 640, one->y() * 400);
    ++overlapping;
    EXPECT_NEAR(light + lightAt(shown[1], two->x() * 640, two->y() * 400), 0.6, 0.012) << azimuth;
    if (one->x() < 0.905) continue;
    ++beyond;
    EXPECT_LT(light, 1e-3) << azimuth;
  }
  EXPECT_GT(overlapping, 40U);
  EXPECT_GT(beyond, 10U);
  EXPECT_NEAR(lightAt(shown[0], 100, 200), 0.6, 0.012) << "where it is alone";
}

TEST(Projection, ProjectorForOneEyeGivesOnePicture) {
  WallFile hall = roundHall(1, 30 * kDegree, 0.1);
  hall.walls.push_back(hall.walls[0]);
  hall.walls[0].projector->eye = Eye::Left;
  hall.walls[1].projector->eye = Eye::Right;
  auto pictures = HallPictures::create(hall);
  ASSERT_TRUE(pictures) << pictures.error().message;
  const auto paint = [](const PaintedView& view, Picture& picture) {
    picture = Picture(picture.width, picture.height, view.picture == Eye::Left ? 100 : 200);
  };
  for (const std::size_t entry : {0U, 1U}) {
    const auto shown = pictures.value()->draw(entry, headAt({0, 0, 1.6}), paint);
    ASSERT_EQ(shown.size(), 1U);
    EXPECT_EQ(shown[0].at(320, 200)[0], entry == 0 ? 100 : 200);  // they do not share the light
  }
}

TEST(Projection, LightOfAProjectorFollowsItsCurveAndTheDarkestWhite) {
  WallFile hall = roundHall(2, 60 * kDegree, 0.2);
  hall.walls[0].projector->light.gamma = {2.4, 1.8, 1};
  hall.walls[1].projector->light.white = {0.8, 1, 0.5};
  auto pictures = HallPictures::create(hall);
  ASSERT_TRUE(pictures) << pictures.error().message;
  const auto paint = byDirection([](const Vec3&) { return grey(0.5); });
  const auto first = pictures.value()->draw(0, headAt({0, 0, 1.6}), paint)[0];
  const std::uint8_t* at = first.at(100, 200);  // lit by this one alone
  EXPECT_NEAR(std::pow(at[0] / 255.0, 2.4), 0.5 * 0.8, 0.01);
  EXPECT_NEAR(std::pow(at[1] / 255.0, 1.8), 0.5, 0.01);
  EXPECT_NEAR(at[2] / 255.0, 0.5 * 0.5, 0.01);
  const auto second = pictures.value()->draw(1, headAt({0, 0, 1.6}), paint)[0];
  EXPECT_NEAR(lightOf(second.at(540, 200)[0]), 0.5, 0.01);  // this is the darkest, so it needs all it has
}

TEST(Projection, BlackIsAsBrightWhereOneProjectorLightsAsWhereTwoDo) {
  WallFile hall = roundHall(2, 60 * kDegree, 0.2);
  for (WallEntry& e : hall.walls) e.projector->light.black = 0.02;
  auto pictures = HallPictures::create(hall);
  ASSERT_TRUE(pictures) << pictures.error().message;
  const auto paint = byDirection([](const Vec3&) { return grey(0); });
  const auto shown = pictures.value()->draw(0, headAt({0, 0, 1.6}), paint)[0];
  const double range = 1 - 0.02;
  EXPECT_NEAR(0.02 + range * lightOf(shown.at(100, 200)[1]), 0.04, 0.001);
  EXPECT_NEAR(0.02 + range * lightOf(shown.at(638, 200)[1]), 0.02, 0.001);
}

/// Greatest and mean difference of two pictures, over all channels.
std::pair<int, double> differenceOf(const Picture& a, const Picture& b) {
  int most = 0;
  double sum = 0;
  for (std::size_t i = 0; i < a.rgba.size(); ++i) {
    const int d = std::abs(int(a.rgba[i]) - int(b.rgba[i]));
    most = std::max(most, d);
    sum += d;
  }
  return {most, sum / static_cast<double>(a.rgba.size())};
}

TEST(Projection, MeasuredPointsGiveThePictureOfTheLensThatTheyMeasure) {
  const WallFile hall = roundHall(2, 70 * kDegree, 0.2);
  WallFile measured = hall;
  for (WallEntry& e : measured.walls) {
    Projector& p = *e.projector;
    const Projector lens = p;
    MeasuredImage image;
    image.columns = 160;
    image.rows = 100;
    const Vec3 nowhere = Vec3::Constant(std::nan(""));
    for (std::uint32_t r = 0; r < image.rows; ++r)
      for (std::uint32_t c = 0; c < image.columns; ++c)
        image.points.push_back(
            pointLit(lens, hall.screens[0], Vec2((c + 0.5) / image.columns, (r + 0.5) / image.rows))
                .value_or(nowhere));
    p.image = image;
  }
  auto a = HallPictures::create(hall), b = HallPictures::create(measured);
  ASSERT_TRUE(a && b);
  const auto paint = byDirection(
      [](const Vec3& d) { return Vec3(0.5 + 0.4 * d.x(), 0.5 + 0.4 * d.y(), 0.5 + 0.4 * d.z()); });
  const Picture first = a.value()->draw(0, headAt({0.1, 0, 1.5}), paint)[0];
  const Picture second = b.value()->draw(0, headAt({0.1, 0, 1.5}), paint)[0];
  Picture middle[2];
  for (int k = 0; k < 2; ++k) {  // the grid ends where the screen does: rims differ
    middle[k] = Picture(520, 180);
    for (std::uint32_t y = 0; y < 180; ++y)
      std::copy_n((k == 0 ? first : second).at(95, y + 110), 520 * 4, middle[k].at(0, y));
  }
  const auto [most, mean] = differenceOf(middle[0], middle[1]);
  EXPECT_LE(most, 3);
  EXPECT_LT(mean, 0.1);
}

TEST(Projection, PinsGiveThePictureOfTheLensThatTheyDescribe) {
  WallFile hall;
  Screen screen;
  screen.name = "front";
  screen.surface = Wall{"front", {-2, 2, 0.5}, {2, 2, 0.5}, {-2, 2, 2.5}};
  hall.screens.push_back(screen);
  WallEntry entry;
  entry.wall.name = "p";
  Projector p;
  p.width = 640;
  p.height = 400;
  LensImage lens;
  lens.X_RP = {{0.3, -2, 2.4}, det::fromEuler(0.05, -0.15, 0.03)};
  lens.throwRatio = 0.85;
  p.image = lens;
  entry.projector = p;
  hall.walls.push_back(entry);
  WallFile pinned = hall;
  const ScreenSurface surface(hall.screens[0]);
  const ThrownImage image(*hall.walls[0].projector, surface);
  PinnedImage pins;
  const Vec3 corners[] = {{-2, 2, 2.5}, {2, 2, 2.5}, {2, 2, 0.5}, {-2, 2, 0.5}};
  for (std::size_t k = 0; k < 4; ++k) {
    const Vec3 p_P = lens.X_RP.inverse() * corners[k];
    pins.pins[k] = {p_P.x() / p_P.y() * lens.throwRatio + 0.5,
                    0.5 - p_P.z() / p_P.y() * lens.throwRatio * 640 / 400};
  }
  pinned.walls[0].projector->image = pins;
  auto a = HallPictures::create(hall), b = HallPictures::create(pinned);
  ASSERT_TRUE(a && b);
  const auto paint = byDirection(
      [](const Vec3& d) { return Vec3(0.5 + 0.4 * d.x(), 0.5 + 0.4 * d.y(), 0.5 + 0.4 * d.z()); });
  const auto [most, mean] = differenceOf(a.value()->draw(0, headAt({0.1, 0, 1.5}), paint)[1],
                                         b.value()->draw(0, headAt({0.1, 0, 1.5}), paint)[1]);
  EXPECT_LE(most, 1);
  EXPECT_LT(mean, 0.05);
}

TEST(Projection, MaskMultipliesTheLightByChannel) {
  WallFile hall = roundHall(1, 30 * kDegree, 0.1);
  Picture mask(4, 2, 255);
  for (std::uint32_t y = 0; y < 2; ++y) mask.at(0, y)[1] = 0;
  const std::string file = testing::TempDir() + "/projection-mask.png";
  ASSERT_FALSE(writePng(file, mask));
  hall.walls[0].projector->blend.mask = file;
  auto pictures = HallPictures::create(hall);
  ASSERT_TRUE(pictures) << pictures.error().message;
  const auto shown =
      pictures.value()->draw(0, headAt({0, 0, 1.6}), byDirection([](const Vec3&) { return grey(0.5); }))[0];
  EXPECT_NEAR(lightOf(shown.at(60, 200)[0]), 0.5, 0.01);
  EXPECT_EQ(shown.at(60, 200)[1], 0);
  EXPECT_NEAR(lightOf(shown.at(160, 200)[1]), 0.25, 0.01);  // halfway between the mask's first two pixels
  hall.walls[0].projector->blend.mask = "/missing/mask.png";
  EXPECT_FALSE(HallPictures::create(hall));
}

TEST(Projection, MapsInsideAFileScaleLightAndLiftBlack) {
  WallFile hall = roundHall(1, 30 * kDegree, 0.1);
  hall.walls[0].projector->blend.alpha = LightMap{1, 1, 1, {32768}, 1};
  hall.walls[0].projector->blend.beta = LightMap{1, 1, 3, {6554, 0, 0}, 1};
  auto pictures = HallPictures::create(hall);
  ASSERT_TRUE(pictures) << pictures.error().message;
  for (const double light : {0.0, 1.0}) {
    const auto shown = pictures.value()->draw(0, headAt({0, 0, 1.6}),
                                              byDirection([&](const Vec3&) { return grey(light); }))[0];
    EXPECT_NEAR(lightOf(shown.at(320, 200)[0]), 0.5 * 0.9 * light + 0.1, 0.006);
    EXPECT_NEAR(lightOf(shown.at(320, 200)[1]), 0.5 * light, 0.006);
  }
}

TEST(Projection, PointsOfAnAnamorphicLensLeadBack) {
  WallFile hall = roundHall(1, 30 * kDegree, 0.1);
  auto& lens = std::get<LensImage>(hall.walls[0].projector->image);
  lens.pixelAspect = 1.25;
  const ScreenSurface surface(hall.screens[0]);
  const ThrownImage image(*hall.walls[0].projector, surface);
  for (const Vec2& share : {Vec2(0.5, 0.5), Vec2(0.3, 0.6), Vec2(0.7, 0.4)}) {
    const auto point = image.pointAt(share);
    ASSERT_TRUE(point);
    const auto back = image.shareOf(*point);
    ASSERT_TRUE(back);
    EXPECT_LT((*back - share).norm(), 1e-9);
  }
}

TEST(Projection, FisheyeOfADomeTakesAFewFacets) {
  WallFile hall;
  Screen screen;
  screen.name = "dome";
  screen.surface = SphereScreen{{0, 0, 1}, 4, -kPi, kPi, 0, kPi / 2, 0};
  hall.screens.push_back(screen);
  hall.visitor = {{0, 0, 1}, 0.3};
  WallEntry entry;
  entry.wall.name = "master";
  Projector p;
  p.width = p.height = 512;
  p.image = FisheyeImage{{{0, 0, 1}, det::fromEuler(kPi / 2, 0, 0)}, kPi};
  entry.projector = p;
  hall.walls.push_back(entry);
  DrawPool pool(2);
  const auto made = makeProjections(hall, pool);
  ASSERT_TRUE(made) << made.error().message;
  const Facets& facets = made.value()[0]->facets();
  EXPECT_GE(facets.all.size(), 2U);
  EXPECT_LE(facets.all.size(), 4U);
}

TEST(Projection, KernelsOfAllWidthsGiveTheSamePixels) {
  const WallFile hall = roundHall(2, 70 * kDegree, 0.2);
  DrawPool pool(2);
  auto made = makeProjections(hall, pool);
  ASSERT_TRUE(made);
  const Projection& projection = *made.value()[0];
  Picture source(projection.facets().width, projection.facets().height);
  unsigned random = 1;
  for (std::uint8_t& b : source.rgba)
    b = static_cast<std::uint8_t>((random = random * 1664525 + 1013904223) >> 24);
  std::vector<FacetPicture> facets;
  for (const Facet& f : projection.facets().all) {
    const EyeFrustum frustum = eyeFrustum(f.rectangle, {0, 0, 1.6}, hall.depth);
    facets.push_back({projectionMatrix(frustum) * viewMatrix(frustum, Pose{}, Vec3::Zero()), &source});
  }
  Picture four, best, alone;
  projection.draw(facets, four, nullptr, kWarpByFour);
  projection.draw(facets, best, &pool);
  EXPECT_EQ(imageHash(four), imageHash(best));
#ifdef __x86_64__
  if (__builtin_cpu_supports("avx2")) {
    projection.draw(facets, alone, nullptr, kWarpByEight);
    EXPECT_EQ(imageHash(four), imageHash(alone));
  }
#endif
}

TEST(Projection, ProjectorThatLightsNothingIsAnError) {
  WallFile hall = roundHall(1, 30 * kDegree, 0);
  std::get<LensImage>(hall.walls[0].projector->image).X_RP.q = det::fromEuler(0, 0, kPi);
  hall.walls[0].line = 7;
  const auto pictures = HallPictures::create(hall);
  ASSERT_FALSE(pictures);
  EXPECT_EQ(pictures.error().where.line, 7U);
}

}  // namespace
}  // namespace stadion
