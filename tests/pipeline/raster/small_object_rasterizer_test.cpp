/// Small things that are drawn without OpenGL look as OpenGL draws them.

#include "pipeline/raster/small_object_rasterizer.h"
#include "tests/pipeline/cull/cull_room.h"
#include "tests/pipeline/gl_draw/renderer_scene.h"

#include <gtest/gtest.h>
#include <thread>

namespace stadion {
namespace {

using test::Random;

constexpr int kSmallWidth = 37, kSmallHeight = 23;

/// Corners, pixels from the picture's middle; nearness; colours.
struct Corners {
  std::vector<float> x, y, nearness, r, g, b;
  std::vector<unsigned> triangles;

  void add(const Vec3& at, const Vec3& colour) {
    x.push_back(static_cast<float>(at.x()));
    y.push_back(static_cast<float>(at.y()));
    nearness.push_back(static_cast<float>(at.z()));
    r.push_back(static_cast<float>(colour.x()));
    g.push_back(static_cast<float>(colour.y()));
    b.push_back(static_cast<float>(colour.z()));
    triangles.push_back(static_cast<unsigned>(triangles.size()));
  }
  PictureVertices vertices() { return {x.data(), y.data(), nearness.data(), r.data(), g.data(), b.data()}; }
};

struct Drawn {
  std::vector<unsigned> colours = std::vector<unsigned>(kSmallWidth * kSmallHeight, 0xff000000U);
  std::vector<float> depths = std::vector<float>(kSmallWidth * kSmallHeight, 0.0f);
  RasterTarget target() { return {colours.data(), depths.data(), kSmallWidth, kSmallHeight, 0.05f, 0.0f}; }
  bool operator==(const Drawn&) const = default;
};

Drawn drawn(Corners& corners, float facing, const RasterKernels& kernels) {
  Drawn picture;
  kernels.draw(corners.triangles.data(), static_cast<unsigned>(corners.triangles.size() / 3),
               corners.vertices(), facing, picture.target());
  return picture;
}

/// On quarters of a pixel, so that middles lie on edges often.
Corners someTriangles(Random& random, int count) {
  Corners corners;
  const auto onGrid = [](double x) { return std::round(4 * x) / 4; };
  for (int t = 0; t < count; ++t) {
    const double size = random.sizeFrom(1, 30);
    const Vec3 at = random.within(1).cwiseProduct(Vec3(kSmallWidth / 2.0, kSmallHeight / 2.0, 0));
    for (int k = 0; k < 3; ++k) {
      const Vec3 off = random.within(size);
      corners.add({onGrid(at.x() + off.x()), onGrid(at.y() + off.y()), random.from(0.5, 2)},
                  {random.from(0, 1), random.from(0, 1), random.from(0, 1)});
    }
  }
  return corners;
}

/// Inside, or on an edge that goes down or to the right, in whole steps of 1/256 pixel.
bool covers(const Corners& c, int first, int x, int y, float facing) {
  std::array<std::array<long, 2>, 3> p;
  for (int k = 0; k < 3; ++k)
    p[k] = {std::lround(256 * c.x[first + k]) + 256 * (kSmallWidth / 2),
            std::lround(256 * c.y[first + k]) + 256 * (kSmallHeight / 2)};
  const auto side = [](const auto& a, const auto& b, const auto& q) {
    return (b[0] - a[0]) * (q[1] - a[1]) - (b[1] - a[1]) * (q[0] - a[0]);
  };
  const long area = side(p[0], p[1], p[2]);
  if (area == 0 || (facing > 0 && area < 0) || (facing < 0 && area > 0)) return false;
  if (area < 0) std::swap(p[1], p[2]);
  const std::array<long, 2> middle{256L * x + 128, 256L * y + 128};
  for (int k = 0; k < 3; ++k) {
    const auto &a = p[k], &b = p[(k + 1) % 3];
    const long at = side(a, b, middle);
    const bool takesEdge = b[1] < a[1] || (b[1] == a[1] && b[0] > a[0]);
    if (at < 0 || (at == 0 && !takesEdge)) return false;
  }
  return true;
}

TEST(SmallObjectRasterizer, PixelsAreThoseWhoseMiddlesAreInside) {
  Random random(41);
  std::size_t pixels = 0;
  for (int round = 0; round < 900; ++round) {
    Corners c = someTriangles(random, 1);
    const float facing = static_cast<float>(round % 3 - 1);
    const Drawn picture = drawn(c, facing, bestRaster());
    for (int y = 0; y < kSmallHeight; ++y)
      for (int x = 0; x < kSmallWidth; ++x) {
        const bool is = picture.depths[y * kSmallWidth + x] != 0;
        ASSERT_EQ(is, covers(c, 0, x, y, facing)) << "round " << round << ", " << x << ", " << y;
        pixels += is;
      }
  }
  EXPECT_GT(pixels, 10000U);
}

TEST(SmallObjectRasterizer, TrianglesOfOneSurfaceShareNoPixelAndLeaveNone) {
  Random random(42);
  for (int round = 0; round < 200; ++round) {
    Corners c;
    const auto at = [&](double x, double y) { return Vec3(std::round(4 * x) / 4, std::round(4 * y) / 4, 1); };
    const Vec3 middle = at(random.from(-4, 4), random.from(-4, 4));
    const Vec3 rim[] = {at(-9, -9), at(9, -9), at(9, 9), at(-9, 9)};
    for (int k = 0; k < 4; ++k)
      c.add(middle, {1, 1, 1}), c.add(rim[k], {1, 1, 1}), c.add(rim[(k + 1) % 4], {1, 1, 1});
    for (int y = 0; y < kSmallHeight; ++y)
      for (int x = 0; x < kSmallWidth; ++x) {
        int times = 0;
        for (int t = 0; t < 4; ++t) times += covers(c, 3 * t, x, y, 1);
        const bool inside = x >= kSmallWidth / 2 - 9 && x < kSmallWidth / 2 + 9 &&
                            y >= kSmallHeight / 2 - 9 && y < kSmallHeight / 2 + 9;
        ASSERT_EQ(times, inside);
      }
    const Drawn picture = drawn(c, 1, bestRaster());
    EXPECT_EQ(std::ranges::count(picture.colours, 0xffffffffU), 18 * 18);
  }
}

TEST(SmallObjectRasterizer, ColoursAndDepthsGoOverTheSurfaceAsInSpace) {
  Random random(43);
  for (int round = 0; round < 300; ++round) {
    Corners c = someTriangles(random, 1);
    const Drawn picture = drawn(c, 0, bestRaster());
    Eigen::Matrix3d corners;
    for (int k = 0; k < 3; ++k)
      corners.col(k) = Vec3(double{c.x[k]} + kSmallWidth / 2, double{c.y[k]} + kSmallHeight / 2, 1);
    for (int y = 0; y < kSmallHeight; ++y)
      for (int x = 0; x < kSmallWidth; ++x) {
        const int at = y * kSmallWidth + x;
        if (picture.depths[at] == 0) continue;
        Vec3 part = corners.inverse() * Vec3(x + 0.5, y + 0.5, 1);
        for (int k = 0; k < 3; ++k) part[k] *= double{c.nearness[k]};
        EXPECT_NEAR(double{picture.depths[at]}, 0.05 * part.sum(), 2e-6);
        part /= part.sum();
        for (int channel = 0; channel < 3; ++channel) {
          const auto& of = channel == 0 ? c.r : channel == 1 ? c.g : c.b;
          const double expected =
              255 * (part[0] * double{of[0]} + part[1] * double{of[1]} + part[2] * double{of[2]});
          EXPECT_NEAR(picture.colours[at] >> (8 * channel) & 255, expected, 0.52) << round;
        }
      }
  }
}

TEST(SmallObjectRasterizer, WhatIsNearestIsSeenInAnyOrder) {
  Random random(44);
  Corners c = someTriangles(random, 60);
  Corners equal = c;
  for (float& n : equal.nearness) n = 1;
  for (Corners* each : {&c, &equal}) {
    const Drawn once = drawn(*each, 0, bestRaster());
    for (std::size_t t = 0; t + 3 < each->triangles.size(); t += 3)
      std::swap_ranges(each->triangles.begin() + static_cast<long>(t),
                       each->triangles.begin() + static_cast<long>(t) + 3,
                       each->triangles.begin() + static_cast<long>(random.below(60) * 3));
    EXPECT_EQ(drawn(*each, 0, bestRaster()), once);
  }
}

TEST(SmallObjectRasterizer, FourAtATimeAndEightGiveTheSame) {
  if (!__builtin_cpu_supports("avx2")) GTEST_SKIP() << "no AVX2";
  Random random(45);
  for (int round = 0; round < 200; ++round) {
    Corners c = someTriangles(random, 1 + static_cast<int>(random.below(30)));
    ASSERT_EQ(drawn(c, 0, kRasterByFour), drawn(c, 0, kRasterByEight)) << round;
  }
  const std::unique_ptr<Mesh> ball = test::MeshMaker(test::matt(0.7f, 0.6f, 0.5f)).sphere(1, 9).seal();
  const CullerMesh mesh(*ball, ball->indices);
  const MeshShading shading(*ball);
  const DrawView eye = test::lookAt(Vec3::Zero(), Vec3(0, 1, 0), 1.2, 1.5);
  const SceneBlock scene = fillScene({}, std::vector<DrawLight>(3), Look::Plain);
  SmallObjectRasterizer four(301, 200, kRasterByFour), eight(301, 200, kRasterByEight);
  for (SmallObjectRasterizer* things : {&four, &eight}) {
    things->begin(eye, scene, {0.1f, 0.2f, 0.3f});
    EXPECT_TRUE(things->place(mesh, shading, {1, 0, 0, 0.5f, 0, 1, 0, 20, 0, 0, 1, 0.2f}));
    EXPECT_GT(things->draw(0, static_cast<std::uint32_t>(ball->indices.size() / 3),
                           TriangleCuller::Facing::CounterClockwise, shading.materials[0], 0,
                           static_cast<std::uint32_t>(ball->positions.size())),
              20U);
  }
  EXPECT_TRUE(std::ranges::equal(four.colours(), eight.colours()));
  EXPECT_TRUE(std::ranges::equal(four.depths(), eight.depths()));
}

/// What differs between the two ways, of all that is shown.
struct Differences {
  std::size_t pixels = 0, rounded = 0, others = 0;
  std::uint64_t calls[2] = {0, 0};
};

void compare(const MeshStore& meshes, const DrawList& list, std::uint32_t width, std::uint32_t height,
             Differences& found) {
  std::array<std::vector<std::uint8_t>, 2> pictures;
  for (const bool here : {false, true}) {
    auto target = test::provider(GlProviderKind::OsMesa)->create(width, height);
    ASSERT_TRUE(target && !target.value()->makeCurrent());
    RenderQuality quality = RenderQuality::plain();
    quality.drawsSmallObjects = here;
    auto renderer =
        GlRenderer::create(target.value()->gl(), target.value()->turns(), meshes, width, height, quality);
    ASSERT_TRUE(renderer);
    pictures[here].resize(std::size_t{width} * height * 4);
    for (std::uint32_t again = 0; again < 2; ++again) {
      const auto wrong = renderer.value()->draw(list, 0);
      ASSERT_FALSE(wrong) << wrong->message;
    }
    ASSERT_FALSE(renderer.value()->read(0, pictures[here]));
    found.calls[here] += renderer.value()->counts().calls;
    renderer.value().reset();
  }
  for (std::size_t i = 0; i < pictures[0].size(); i += 4) {
    int most = 0;
    for (std::size_t k = 0; k < 4; ++k)
      most = std::max(most, std::abs(pictures[0][i + k] - pictures[1][i + k]));
    ++found.pixels, found.rounded += most == 1, found.others += most > 1;
  }
}

DrawList manyThings(MeshStore& meshes, Random& random, double aspect) {
  DrawList list = test::richList(meshes, aspect);
  std::erase_if(list.lights, [](const DrawLight& l) { return l.kind != DrawLight::Kind::Directional; });
  list.shadows.light = -1, list.sky.hazeDistance = 0;
  test::MeshMaker sheet(test::matt(0.2f, 0.5f, 0.8f));
  sheet.quad({-1, 0, -1}, {1, 0, -1}, {1, 0, 1}, {-1, 0, 1});
  test::MeshMaker picture(test::matt(1, 1, 1));
  picture.texture(test::chequered(16, 4)).quad({-1, 0, -1}, {1, 0, -1}, {1, 0, 1}, {-1, 0, 1});
  const MeshId ids[] = {
      meshes.add(test::MeshMaker(test::matt(0.9f, 0.2f, 0.1f)).sphere(1, 12).seal()),
      meshes.add(test::MeshMaker(test::matt(0.1f, 0.8f, 0.1f)).box(Vec3(-1, -1, -1), Vec3(1, 1, 1)).seal()),
      meshes.add(sheet.seal()), meshes.add(picture.seal())};
  for (int i = 0; i < 500; ++i) {
    Affine X = Affine::Identity();
    X.translation() = Vec3(0, random.sizeFrom(i % 9 == 0 ? 0.5 : 8, 60), 0) + 0.2 * random.within(60);
    X.linear() = random.turned().toRotationMatrix() * random.sizeFrom(0.1, 3);
    if (i % 5 == 0) X.linear().col(0) *= -1;
    list.opaque.push_back(test::place(ids[i % 4], X));
    list.opaque.back().distance = static_cast<float>(X.translation().norm());
  }
  std::ranges::stable_sort(list.opaque, {}, &DrawItem::mesh);
  list.views[0] = test::lookAt(0.1 * random.within(1), Vec3(0, 1, 0), 1.3, aspect);
  return list;
}

TEST(PictureSmallObjectRasterizer, PicturesAreThoseThatOpenGlDrawsButForRounding) {
  Random random(46);
  Differences found;
  for (int round = 0; round < 12; ++round) {
    MeshStore meshes;
    const std::uint32_t width = 120 + random.below(90), height = 90 + random.below(70);
    const DrawList list = manyThings(meshes, random, double(width) / height);
    ASSERT_NO_FATAL_FAILURE(compare(meshes, list, width, height, found));
  }
  EXPECT_LT(3 * found.calls[1], 2 * found.calls[0]) << "most of it is drawn here";
  EXPECT_LT(found.others, found.pixels / 1000) << "by more than rounding";
  RecordProperty("rounded", static_cast<int>(found.rounded));
  RecordProperty("others", static_cast<int>(found.others));
}

/// Each gives its turn at the rasteriser away while it draws small things.
TEST(ThreadsSmallObjectRasterizer, WallsThatDrawThemSideBySideAllDrawTheSame) {
  constexpr std::size_t kWalls = 3;
  Random random(48);
  MeshStore meshes;
  DrawList list = manyThings(meshes, random, 1.5);
  list.views[1] = list.views[0];
  list.viewCount = 2;
  std::array<std::vector<std::vector<std::uint8_t>>, kWalls> pictures;
  const auto play = [&](std::size_t wall) {
    auto target = test::provider(GlProviderKind::OsMesa)->create(90, 60);
    if (!target || target.value()->makeCurrent()) return;
    auto renderer = GlRenderer::create(target.value()->gl(), target.value()->turns(), meshes, 90, 60,
                                       RenderQuality::plain());
    for (int i = 0; renderer && i < 6; ++i) {
      std::vector<std::uint8_t> picture(90 * 60 * 4);
      if (renderer.value()->draw(list) || renderer.value()->read(i % 2, picture)) break;
      pictures[wall].push_back(std::move(picture));
    }
    if (renderer) renderer.value().reset();
  };
  {
    std::array<std::jthread, kWalls> threads;
    for (std::size_t wall = 0; wall < kWalls; ++wall) threads[wall] = std::jthread(play, wall);
  }
  for (const auto& of : pictures) {
    ASSERT_EQ(of.size(), 6U);
    for (const auto& picture : of) EXPECT_EQ(picture, pictures[0][0]);
  }
}

TEST(PictureSmallObjectRasterizer, LampsAndHazeAreLeftToOpenGl) {
  Random random(47);
  MeshStore meshes;
  DrawList list = manyThings(meshes, random, 1.5);
  DrawList hazy = list;
  hazy.sky.hazeDistance = 40;
  list.lights.push_back({DrawLight::Kind::Point});
  for (const DrawList* each : {&list, &hazy}) {
    Differences found;
    ASSERT_NO_FATAL_FAILURE(compare(meshes, *each, 150, 100, found));
    EXPECT_EQ(found.calls[0], found.calls[1]);
    EXPECT_EQ(found.rounded + found.others, 0U);
  }
}

}  // namespace
}  // namespace stadion
