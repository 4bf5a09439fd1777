/// Colour tables of projectors: what they make of encoded values, with all kernels.

#include "engine/colour_table/cube_file.h"
#include "engine/maths/srgb.h"
#include "pipeline/projection/hall_pictures.h"
#include "tests/fresh_folder.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <gtest/gtest.h>
#include <random>

namespace stadion {
namespace {

/// A plane that one projector fills, pixel for pixel.
WallFile filledPlane(const ColourTable& table, const std::array<double, 3>& gamma) {
  WallFile hall;
  Screen screen;
  screen.name = "front";
  screen.surface = Wall{"front", {-1, 2, 0.7}, {1, 2, 0.7}, {-1, 2, 2.7}};
  hall.screens.push_back(screen);
  hall.visitor = {{0, 0, 1.7}, 0.1};
  WallEntry entry;
  entry.wall.name = "p";
  Projector p;
  p.width = p.height = 16;
  p.image = PinnedImage{{Vec2(0, 0), Vec2(1, 0), Vec2(1, 1), Vec2(0, 1)}};
  p.light.gamma = gamma;
  p.lut = ProjectorLut{"t.cube", table};
  entry.projector = p;
  hall.walls.push_back(entry);
  return hall;
}

ColourTable randomTable(std::uint32_t curve, std::uint32_t solid, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> value(-0.1f, 1.1f);
  ColourTable table;
  table.curveSize = curve;
  table.solidSize = solid;
  for (std::uint32_t i = 0; i < curve; ++i)
    for (int c = 0; c < 3; ++c)  // bent, but each row of pixels keeps different values
      table.curve.push_back(
          std::pow(static_cast<float>(i) / static_cast<float>(curve - 1), 0.6f + 0.3f * float(c)));
  for (std::uint32_t i = 0; i < solid * solid * solid * 3; ++i) table.solid.push_back(value(random));
  if (curve > 0) table.curveRange = {{-0.05, 0, 0.1}, {1.05, 0.9, 1}};
  if (solid > 0) table.solidRange = {{0, 0.1, -0.2}, {1, 0.95, 1.2}};
  return table;
}

/// Where a value lies between the entries of a table.
struct ReferencePlace {
  std::size_t entry;
  double beyond;
};

ReferencePlace placeOf(double value, double low, double high, std::uint32_t size) {
  const double at = std::clamp((value - low) / (high - low) * (size - 1), 0.0, double(size - 1));
  const std::size_t entry = std::min(static_cast<std::size_t>(at), std::size_t{size} - 2);
  return {entry, at - double(entry)};
}

/// The table in double precision. Of a solid, the six tetrahedra are written out.
Vec3 reference(const ColourTable& t, Vec3 v) {
  if (t.curveSize > 0)
    for (std::size_t c = 0; c < 3; ++c) {
      const auto at = placeOf(v[int(c)], t.curveRange.low[c], t.curveRange.high[c], t.curveSize);
      v[int(c)] = (1 - at.beyond) * t.curve[3 * at.entry + c] + at.beyond * t.curve[3 * at.entry + 3 + c];
    }
  if (t.solidSize == 0) return v;
  ReferencePlace at[3];
  for (std::size_t c = 0; c < 3; ++c)
    at[c] = placeOf(v[int(c)], t.solidRange.low[c], t.solidRange.high[c], t.solidSize);
  const auto corner = [&](std::size_t r, std::size_t g, std::size_t b) -> Vec3 {
    const std::size_t n = t.solidSize,
                      i = 3 * ((at[2].entry + b) * n * n + (at[1].entry + g) * n + at[0].entry + r);
    return {t.solid[i], t.solid[i + 1], t.solid[i + 2]};
  };
  const double r = at[0].beyond, g = at[1].beyond, b = at[2].beyond;
  const Vec3 black = corner(0, 0, 0), white = corner(1, 1, 1);
  if (r >= g && g >= b)
    return (1 - r) * black + (r - g) * corner(1, 0, 0) + (g - b) * corner(1, 1, 0) + b * white;
  if (r >= b && b >= g)
    return (1 - r) * black + (r - b) * corner(1, 0, 0) + (b - g) * corner(1, 0, 1) + g * white;
  if (b >= r && r >= g)
    return (1 - b) * black + (b - r) * corner(0, 0, 1) + (r - g) * corner(1, 0, 1) + g * white;
  if (b >= g && g >= r)
    return (1 - b) * black + (b - g) * corner(0, 0, 1) + (g - r) * corner(0, 1, 1) + r * white;
  if (g >= b && b >= r)
    return (1 - g) * black + (g - b) * corner(0, 1, 0) + (b - r) * corner(0, 1, 1) + r * white;
  return (1 - g) * black + (g - r) * corner(0, 1, 0) + (r - b) * corner(1, 1, 0) + b * white;
}

double encoded(double light, double gamma) {
  return gamma > 0 ? std::pow(light, 1 / gamma) : srgbFromLinear(light);
}

TEST(ProjectorTable, MapsEncodedValuesAsTheReferenceDoes) {
  const std::array<double, 3> gamma{2.2, 0, 1.8};
  for (const auto& [curve, solid] : {std::pair{17u, 0u}, {0u, 2u}, {0u, 9u}, {5u, 4u}}) {
    const ColourTable table = randomTable(curve, solid, curve + solid);
    auto pictures = HallPictures::create(filledPlane(table, gamma));
    ASSERT_TRUE(pictures) << pictures.error().message;
    std::mt19937 random(7);
    double worst = 0;
    for (int trial = 0; trial < 150; ++trial) {
      std::uint8_t colour[3];
      for (std::uint8_t& c : colour) c = static_cast<std::uint8_t>(random() % 256);
      if (trial < 8)  // the corners of the cube of colours
        for (int c = 0; c < 3; ++c) colour[c] = trial >> c & 1 ? 255 : 0;
      if (trial >= 8 && trial < 16) colour[0] = colour[1] = colour[2];  // on the diagonal all ways are equal
      const auto paint = [&](const PaintedView&, Picture& picture) {
        for (std::size_t i = 0; i < picture.rgba.size(); ++i)
          picture.rgba[i] = i % 4 < 3 ? colour[i % 4] : 255;
      };
      const Picture shown = pictures.value()->draw(0, {{0, 0, 1.7}, Quat::Identity()}, paint)[0];
      Vec3 values;
      for (int c = 0; c < 3; ++c)
        values[c] = encoded(linearFromSrgb(colour[c] / 255.0), gamma[std::size_t(c)]);
      const Vec3 expected = 255 * reference(table, values).cwiseMax(0).cwiseMin(1);
      for (int c = 0; c < 3; ++c) worst = std::max(worst, std::abs(shown.at(8, 8)[c] - expected[c]));
    }
    EXPECT_LT(worst, 0.6) << curve << " " << solid;  // half a value is rounding
  }
}

TEST(ProjectorTable, GivesTheSamePixelsWithKernelsOfAllWidths) {
  DrawPool pool(1);
  const WallFile hall = filledPlane(randomTable(9, 5, 3), {0, 0, 0});
  auto made = makeProjections(hall, pool);
  ASSERT_TRUE(made);
  const Projection& projection = *made.value()[0];
  Picture source(projection.facets().width, projection.facets().height);
  std::mt19937 random(1);
  for (std::uint8_t& b : source.rgba) b = static_cast<std::uint8_t>(random());
  const EyeFrustum frustum = eyeFrustum(projection.facets().all[0].rectangle, {0, 0, 1.7}, hall.depth);
  const std::vector<FacetPicture> facets{
      {projectionMatrix(frustum) * viewMatrix(frustum, Pose{}, Vec3::Zero()), &source}};
  Picture four, other;
  projection.draw(facets, four, nullptr, kWarpByFour);
#ifdef __x86_64__
  if (__builtin_cpu_supports("avx2")) {
    projection.draw(facets, other, nullptr, kWarpByEight);
    EXPECT_EQ(imageHash(four), imageHash(other));
  }
#endif
  projection.draw(facets, other, nullptr, bestWarpKernels());
  EXPECT_EQ(imageHash(four), imageHash(other));
}

TEST(ProjectorTable, ThatChangesNothingLeavesThePictureAsItIs) {
  ColourTable same;
  same.solidSize = 2;
  for (int i = 0; i < 8; ++i)
    for (int c = 0; c < 3; ++c) same.solid.push_back(static_cast<float>(i >> c & 1));
  const WallFile with = filledPlane(same, {0, 0, 0}), without = filledPlane({}, {0, 0, 0});
  auto a = HallPictures::create(with), b = HallPictures::create(without);
  ASSERT_TRUE(a && b);
  const auto paint = [](const PaintedView&, Picture& picture) {
    std::mt19937 random(2);
    for (std::uint8_t& v : picture.rgba) v = static_cast<std::uint8_t>(random());
  };
  const Pose head{{0, 0, 1.7}, Quat::Identity()};
  const Picture one = a.value()->draw(0, head, paint)[0], two = b.value()->draw(0, head, paint)[0];
  int most = 0;
  for (std::size_t i = 0; i < one.rgba.size(); ++i)
    most = std::max(most, std::abs(int(one.rgba[i]) - int(two.rgba[i])));
  EXPECT_LE(most, 1);  // one of them rounds the light before it is encoded
}

TEST(ProjectorTable, IsReadBesideTheWallFileAndWrongOnesAreNamed) {
  const FreshFolder fresh;
  const std::filesystem::path& folder = fresh.path();
  const std::string walls = (folder / "hall.walls").string();
  std::ofstream(walls) << "screen front plane lower-left -1 2 0.7 lower-right 1 2 0.7 upper-left -1 2 2.7\n"
                          "projector p screen front pixels 64 64 pins 0 0 1 0 1 1 0 1 lut p.cube\n";
  std::ofstream(folder / "p.cube") << "LUT_1D_SIZE 2\n0 0 0\n1 1 x\n";
  Diagnostics out;
  EXPECT_FALSE(loadWalls(walls, "", out));
  ASSERT_EQ(out.all().size(), 1u);
  EXPECT_EQ(out.all()[0].where.file, (folder / "p.cube").string());
  EXPECT_EQ(out.all()[0].where.line, 3u);
  EXPECT_EQ(out.all()[0].where.column, 5u);
  std::ofstream(folder / "p.cube") << "LUT_1D_SIZE 2\n0 0 0\n1 1 0.5\n";
  Diagnostics none;
  const auto hall = loadWalls(walls, "", none);
  ASSERT_TRUE(hall);
  EXPECT_EQ(hall->walls[0].projector->lut->table.curve[5], 0.5f);
  EXPECT_NE(formatWalls(*hall).find("lut p.cube"), std::string::npos);
}

}  // namespace
}  // namespace stadion
