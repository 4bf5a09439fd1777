/// Which eyes see a thing: never too few, and pictures are the same as if both drew everything.

#include "pipeline/cull/eye_test.h"
#include "tests/pipeline/cull/cull_room.h"
#include "tests/pipeline/gl_draw/renderer_scene.h"

#include <gtest/gtest.h>

namespace stadion {
namespace {

using test::Random;
using test::thing;

DrawList listOf(const std::vector<WallViews>& views, const ViewerRecord& viewer, std::size_t wall) {
  DrawList list;
  place(viewer, views[wall], {}).setUp(list);
  return list;
}

std::array<float, 3> single(const Vec3& p) {
  return {static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z())};
}

/// Where the ray through a pixel's middle goes, from the eye, in eye coordinates with a depth of 1.
Vec3 throughPixel(const DrawView& eye, double x, double y, double width, double height) {
  const double ndcX = 2 * (x + 0.5) / width - 1, ndcY = 2 * (y + 0.5) / height - 1;
  const Mat4& p = eye.projection;
  return {(ndcX + p(0, 2)) / p(0, 0), (ndcY + p(1, 2)) / p(1, 1), -1};
}

/// Whether the ray through any pixel's middle meets the sphere (in eye coordinates).
bool meetsAMiddle(const DrawView& eye, const Vec3& centre, double radius, int width, int height) {
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const Vec3 way = throughPixel(eye, x, y, width, height).normalized();
      if (way.cross(centre).norm() <= radius && way.dot(centre) > 0) return true;
    }
  return false;
}

TEST(EyeTest, AnEyeSeesWhatTouchesItsFrustumAndHardlyAnythingElse) {
  Random random(21);
  std::size_t touched = 0, kept = 0;
  for (int round = 0; round < 200; ++round) {
    std::vector<WallViews> views = test::boxRoom(random.from(0.5, 3), {0.1, 200});
    ViewerRecord viewer;
    viewer.set({random.within(50), random.turned()}, test::headIn(views[0].views[0].screen.lowerRight.x(), random));
    const std::size_t wall = random.below(6);
    const PlacedViews placed = place(viewer, views[wall], {});
    const EyeTest sees(listOf(views, viewer, wall), false, 800, 600);
    for (int i = 0; i < 500; ++i) {
      const Vec3 centre = random.within(100);
      const double radius = random.sizeFrom(1e-3, 5);
      const std::uint8_t seen = sees.viewsThatSee(single(centre), static_cast<float>(radius));
      for (std::uint32_t e = 0; e < 2; ++e) {
        ConvexVolume sides = placed.volume(e, e + 1);
        sides.count = 4;
        const bool touches = sides.mayTouch(Sphere{centre, radius});
        ASSERT_TRUE(!touches || (seen >> e & 1)) << "round " << round << ", eye " << e;
        touched += touches, kept += seen >> e & 1;
      }
    }
  }
  EXPECT_GT(touched, 10000U);
  EXPECT_LE(static_cast<double>(kept), 1.002 * static_cast<double>(touched));
}

TEST(EyeTest, WhatAPixelsMiddleMayMeetIsSeen) {
  Random random(22);
  constexpr int kWidth = 32, kHeight = 24;
  std::size_t met = 0, left = 0, leftOut = 0;
  for (int round = 0; round < 300; ++round) {
    const std::vector<WallViews> views = test::boxRoom(1.5, {0.1, 200});
    ViewerRecord viewer;
    viewer.set({random.within(50), random.turned()}, test::headIn(1.5, random));
    const std::size_t wall = random.below(6);
    const DrawList list = listOf(views, viewer, wall);
    const EyeTest closely(list, true, kWidth, kHeight), sides(list, false, kWidth, kHeight);
    for (int i = 0; i < 200; ++i) {
      const Vec3 centre = random.within(60);
      const double radius = random.sizeFrom(1e-2, 1);
      const auto size = static_cast<float>(radius);
      const std::uint8_t seen = closely.viewsThatSee(single(centre), size),
                         inView = sides.viewsThatSee(single(centre), size);
      ASSERT_EQ(seen & ~inView, 0);
      for (std::uint32_t e = 0; e < 2; ++e) {
        if (!(inView >> e & 1)) continue;
        const Vec4 p = list.views[e].view * centre.homogeneous();
        const bool meets = meetsAMiddle(list.views[e], p.head<3>(), radius, kWidth, kHeight);
        ASSERT_TRUE(!meets || (seen >> e & 1)) << "radius " << radius << " at " << p.transpose();
        met += meets, left += !meets, leftOut += !(seen >> e & 1);
      }
    }
  }
  EXPECT_GT(met, 500U);
  EXPECT_GT(leftOut, left / 2) << "most of what meets no middle is left out";
}

TEST(EyeTest, WhatIsNotFiniteIsSeen) {
  const std::vector<WallViews> views = test::boxRoom(1.5, {0.1, 200});
  const EyeTest sees(listOf(views, ViewerRecord(), 0), true, 32, 24);
  EXPECT_EQ(sees.viewsThatSee({NAN, 0, 0}, 1), 3U);
  EXPECT_EQ(sees.viewsThatSee({0, 5, 0}, NAN), 3U);
  EXPECT_EQ(sees.viewsThatSee({0, 5, 0}, INFINITY), 3U);
}

/// Boxes of all sizes about the visitor, some mirrored.
std::vector<InstanceRecord> boxes(Random& random, const std::vector<MeshId>& meshes) {
  std::vector<InstanceRecord> records;
  for (std::uint32_t i = 0; i < 3000; ++i) {
    const double size = random.sizeFrom(0.01, 0.5);
    records.push_back(thing(random.within(20), 1.8 * size, meshes[i % meshes.size()], {1, i}));
    for (const int k : {0, 5, 10}) records.back().model[k] = size;
    if (i % 7 == 0) records.back().model[0] *= -1;
  }
  return records;
}

TEST(PictureEyeTest, PicturesAreThoseOfEyesThatDrawEverything) {
  Random random(23);
  MeshStore meshes;
  std::vector<MeshId> ids;
  for (int i = 0; i < 3; ++i) {
    auto maker = test::MeshMaker(test::matt(0.2f, 0.3f * static_cast<float>(i), 0.5f));
    ids.push_back(meshes.add(maker.box(Vec3(-1, -1, -1), Vec3(1, 1, 1)).seal()));
  }
  test::Frames f;
  ChangeSet c;
  c.chunks = {{f.state.arena().add(boxes(random, ids)), true}};
  c.lightsChanged = true, c.lights.resize(1);
  const SlotView state = f.publish(c);
  std::vector<WallViews> views = test::boxRoom(1.5, {0.1, 100});
  for (WallViews& view : views) view.eyeSeparation = 0.3, view.width = 64, view.height = 48;
  RoomCull room(views);
  auto provider = test::provider(GlProviderKind::OsMesa);
  ASSERT_TRUE(provider);
  auto target = provider->create(64, 48);
  ASSERT_TRUE(target && !target.value()->makeCurrent());
  RenderQuality quality = RenderQuality::plain();
  quality.leavesOutUnseen = false;
  auto renderer = GlRenderer::create(target.value()->gl(), target.value()->turns(), meshes, 64, 48, quality);
  ASSERT_TRUE(renderer);
  std::uint64_t drawn = 0, ofAll = 0;
  for (std::uint32_t wall = 0; wall < views.size(); ++wall) {
    DrawList list;
    WallCull({.room = room, .oneSample = true}, wall).fill(state, {.eyes = {.swapped = true}}, list);
    DrawList all;
    WallCull({.room = room}, wall).fill(state, {.eyes = {.swapped = true}}, all);
    for (DrawItem& item : all.opaque) item.views = DrawItem::kAllViews;
    for (std::uint32_t eye = 0; eye < 2; ++eye) {
      std::vector<std::uint8_t> a(64 * 48 * 4), b(64 * 48 * 4);
      ASSERT_FALSE(renderer.value()->draw(list, eye) || renderer.value()->read(eye, a));
      drawn += renderer.value()->counts().instances;
      ASSERT_FALSE(renderer.value()->draw(all, eye) || renderer.value()->read(eye, b));
      ofAll += renderer.value()->counts().instances;
      EXPECT_EQ(a, b) << "wall " << wall << ", eye " << eye;
    }
  }
  EXPECT_LT(drawn, ofAll * 9 / 10);
  renderer.value().reset();
}

}  // namespace
}  // namespace stadion
