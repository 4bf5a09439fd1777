/// Triangles that make pixels are never left out, and pictures are the same without the others.

#include "pipeline/raster/triangle_culler.h"
#include "tests/pipeline/cull/cull_room.h"
#include "tests/pipeline/gl_draw/renderer_scene.h"

#include <gtest/gtest.h>
#include <set>

namespace stadion {
namespace {

using test::Random;

InstanceMatrix placed(const Affine& X) {
  InstanceMatrix m;
  for (int row = 0; row < 3; ++row)
    for (int k = 0; k < 4; ++k) m[static_cast<std::size_t>(4 * row + k)] = static_cast<float>(X(row, k));
  return m;
}

Affine somewhere(Random& random, double near, double far, bool mirrored) {
  Affine X = Affine::Identity();
  X.translation() = Vec3(0, random.sizeFrom(near, far), 0) + 0.7 * random.within(far) * random.from(0, 1);
  X.linear() = random.turned().toRotationMatrix() * random.sizeFrom(0.1, 3);
  if (mirrored) X.linear().col(0) *= -1;
  return X;
}

/// The pixels' middles inside of a triangle, as OpenGL says, its corners moved onto a grid of 1/256 pixel.
bool makesPixels(const std::array<Vec2, 3>& corners, double facing, int width, int height) {
  std::array<Vec2, 3> p;
  for (std::size_t i = 0; i < 3; ++i)
    p[i] = Vec2(std::round(corners[i].x() * 256) / 256, std::round(corners[i].y() * 256) / 256);
  const auto side = [](const Vec2& a, const Vec2& b, const Vec2& q) {
    return (b.x() - a.x()) * (q.y() - a.y()) - (q.x() - a.x()) * (b.y() - a.y());
  };
  const double area = side(p[0], p[1], p[2]);
  if (area == 0 || facing * area < 0) return false;
  const double sign = area > 0 ? 1 : -1;
  double lo[2] = {1e9, 1e9}, hi[2] = {-1e9, -1e9};
  for (const Vec2& q : p)
    for (int k = 0; k < 2; ++k) lo[k] = std::min(lo[k], q[k]), hi[k] = std::max(hi[k], q[k]);
  for (int y = std::max(0, int(lo[1]) - 1); y <= std::min(height - 1, int(hi[1]) + 1); ++y)
    for (int x = std::max(0, int(lo[0]) - 1); x <= std::min(width - 1, int(hi[0]) + 1); ++x) {
      const Vec2 middle(x + 0.5, y + 0.5);
      bool inside = true;
      for (std::size_t i = 0; i < 3; ++i) inside = inside && sign * side(p[i], p[(i + 1) % 3], middle) >= 0;
      if (inside) return true;
    }
  return false;
}

TEST(TriangleCuller, KeepsWhatMakesPixelsAndLittleElse) {
  Random random(31);
  const std::unique_ptr<Mesh> ball = test::MeshMaker(test::matt(1, 1, 1)).sphere(1, 8).seal();
  const CullerMesh mesh(*ball, ball->indices);
  const auto triangles = static_cast<std::uint32_t>(ball->indices.size() / 3);
  std::size_t made = 0, kept = 0, all = 0;
  for (int round = 0; round < 600; ++round) {
    const int width = 80 + static_cast<int>(random.below(40)),
              height = 60 + static_cast<int>(random.below(40));
    const DrawView eye = test::lookAt(Vec3::Zero(), Vec3(0, 1, 0), 1.2, double(width) / height);
    TriangleCuller culler(static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height));
    const bool mirrored = round % 3 == 0, both = round % 5 == 0;
    const InstanceMatrix model = placed(somewhere(random, 2, 60, mirrored));
    culler.setView(eye);
    culler.place(mesh, model);
    const auto facing = both       ? TriangleCuller::Facing::Both
                        : mirrored ? TriangleCuller::Facing::Clockwise
                                   : TriangleCuller::Facing::CounterClockwise;
    const TriangleCuller::Range range = culler.keep(0, triangles, facing);
    std::set<std::array<std::uint32_t, 3>> found;
    for (std::uint32_t i = range.first; i < range.first + range.count; i += 3)
      found.insert({culler.kept()[i], culler.kept()[i + 1], culler.kept()[i + 2]});
    const Mat4 clip = eye.projection * eye.view;
    for (std::uint32_t t = 0; t < triangles; ++t) {
      std::array<Vec2, 3> at;
      std::array<std::uint32_t, 3> corners;
      bool before = true;
      for (std::size_t k = 0; k < 3; ++k) {
        corners[k] = ball->indices[3 * t + k];
        const auto& p = ball->positions[corners[k]];
        Vec3 world;
        for (int row = 0; row < 3; ++row) {
          const float* m = &model[static_cast<std::size_t>(4 * row)];
          world[row] = double{m[0]} * double{p[0]} + double{m[1]} * double{p[1]} +
                       double{m[2]} * double{p[2]} + double{m[3]};
        }
        const Vec4 q = clip * world.homogeneous();
        before = before && q[3] > 0.1;
        at[k] = Vec2(0.5 * width * (q[0] / q[3] + 1), 0.5 * height * (q[1] / q[3] + 1));
      }
      if (!before) continue;
      const double seen = both ? 0 : mirrored ? -1 : 1;
      const bool makes = makesPixels(at, seen, width, height);
      ASSERT_TRUE(!makes || found.contains(corners)) << "round " << round << ", triangle " << t;
      made += makes, kept += found.contains(corners), ++all;
    }
  }
  EXPECT_GT(made, 5000U);
  EXPECT_LT(kept, all / 2);
}

TEST(TriangleCuller, FourAtATimeAndEightGiveTheSame) {
  if (!__builtin_cpu_supports("avx2")) GTEST_SKIP() << "no AVX2";
  Random random(32);
  const std::unique_ptr<Mesh> ball = test::MeshMaker(test::matt(1, 1, 1)).sphere(1, 9).seal();
  const CullerMesh mesh(*ball, ball->indices);
  const auto triangles = static_cast<std::uint32_t>(ball->indices.size() / 3);
  const DrawView eye = test::lookAt(Vec3::Zero(), Vec3(0, 1, 0), 1.2, 1.5);
  TriangleCuller four(301, 200, kCullByFour), eight(301, 200, kCullByEight);
  for (int round = 0; round < 500; ++round) {
    const InstanceMatrix model = placed(somewhere(random, 0.5, 80, round % 2 == 0));
    for (TriangleCuller* culler : {&four, &eight}) {
      culler->clear();
      culler->setView(eye);
      culler->place(mesh, model);
      culler->keep(random.below(1), triangles - 3, TriangleCuller::Facing(round % 3));
    }
    ASSERT_TRUE(std::ranges::equal(four.kept(), eight.kept())) << "round " << round;
  }
}

TEST(TriangleCuller, WhatReachesBehindTheEyeIsKeptWhole) {
  const std::unique_ptr<Mesh> ball = test::MeshMaker(test::matt(1, 1, 1)).sphere(1, 8).seal();
  const CullerMesh mesh(*ball, ball->indices);
  const auto triangles = static_cast<std::uint32_t>(ball->indices.size() / 3);
  TriangleCuller culler(64, 48);
  culler.setView(test::lookAt(Vec3::Zero(), Vec3(0, 1, 0), 1.2, 1.5));
  InstanceMatrix model = placed(Affine::Identity());
  culler.place(mesh, model);
  EXPECT_EQ(culler.keep(0, triangles, TriangleCuller::Facing::CounterClockwise).count, 3 * triangles);
  EXPECT_TRUE(std::ranges::equal(culler.kept(), ball->indices));
  model.fill(NAN);
  culler.place(mesh, model);
  EXPECT_EQ(culler.keep(1, 2, TriangleCuller::Facing::Both).count, 6U);
}

/// Draws both ways; counts the triangles of each.
void expectSame(const MeshStore& meshes, const DrawList& list, std::uint32_t width, std::uint32_t height,
                std::array<std::uint64_t, 2>& triangles) {
  GlProvider* provider = test::provider(GlProviderKind::OsMesa);
  ASSERT_TRUE(provider);
  std::array<std::vector<std::uint8_t>, 2> pictures;
  for (const bool culled : {false, true}) {
    auto target = provider->create(width, height);
    ASSERT_TRUE(target && !target.value()->makeCurrent());
    RenderQuality quality = RenderQuality::plain();
    quality.leavesOutUnseen = culled, quality.drawsSmallObjects = false;
    auto renderer =
        GlRenderer::create(target.value()->gl(), target.value()->turns(), meshes, width, height, quality);
    ASSERT_TRUE(renderer);
    pictures[culled].resize(std::size_t{width} * height * 4);
    const auto wrong = renderer.value()->draw(list, 0);
    ASSERT_FALSE(wrong) << wrong->message;
    ASSERT_FALSE(renderer.value()->read(0, pictures[culled]));
    triangles[culled] += renderer.value()->counts().triangles;
    renderer.value().reset();
  }
  EXPECT_EQ(pictures[0], pictures[1]) << width << " x " << height;
}

TEST(PictureTriangleCuller, PicturesAreThoseOfAllTriangles) {
  Random random(33);
  for (int round = 0; round < 12; ++round) {
    MeshStore meshes;
    const std::uint32_t width = 90 + random.below(60), height = 60 + random.below(40);
    DrawList list = test::richList(meshes, double(width) / height);
    list.shadows.light = -1;
    test::MeshMaker sheet(test::matt(0.2f, 0.5f, 0.8f));
    sheet.quad({-1, 0, -1}, {1, 0, -1}, {1, 0, 1}, {-1, 0, 1});
    const MeshId ids[] = {
        meshes.add(test::MeshMaker(test::matt(0.9f, 0.2f, 0.1f)).sphere(1, 12).seal()),
        meshes.add(test::MeshMaker(test::matt(0.1f, 0.8f, 0.1f)).box(Vec3(-1, -1, -1), Vec3(1, 1, 1)).seal()),
        meshes.add(sheet.seal())};
    for (int i = 0; i < 300; ++i) {
      const Affine X = somewhere(random, 0.4, 50, i % 4 == 0);
      list.opaque.push_back(test::place(ids[i % 3], X));
      list.opaque.back().distance = static_cast<float>(X.translation().norm());
    }
    std::ranges::stable_sort(list.opaque, {}, &DrawItem::mesh);
    list.views[0] = test::lookAt(0.1 * random.within(1), Vec3(0, 1, 0), 1.3, double(width) / height);
    std::array<std::uint64_t, 2> triangles{};
    ASSERT_NO_FATAL_FAILURE(expectSame(meshes, list, width, height, triangles));
    EXPECT_LT(triangles[1], triangles[0] / 2);
  }
}

}  // namespace
}  // namespace stadion
