/// Any number of views: walls beyond what one search takes, and walls with views through several screens.

#include "tests/pipeline/cull/cull_room.h"
#include "tests/pipeline/gl_draw/renderer_scene.h"

#include <gtest/gtest.h>

#include <set>

namespace stadion {
namespace {

using test::boxRoom;
using test::Random;

/// Boxes of all sizes about the visitor.
std::vector<InstanceRecord> boxesAbout(Random& random, std::uint32_t count, MeshId mesh) {
  std::vector<InstanceRecord> records;
  for (std::uint32_t i = 0; i < count; ++i) {
    const double size = random.sizeFrom(0.02, 1);
    records.push_back(test::thing(random.within(20), 1.8 * size, mesh, {1, i}));
    for (const int k : {0, 5, 10}) records.back().model[k] = size;
  }
  return records;
}

/// The six sides of the room as the screens of one wall, all seen from the middle.
WallViews allIn(const std::vector<WallViews>& room) {
  WallViews all = room.front();
  all.views.clear();
  for (const WallViews& wall : room) all.views.push_back({wall.views[0].screen, ViewPoint::Middle});
  return all;
}

std::set<const InstanceRecord*> setOf(const std::vector<const InstanceRecord*>& records) {
  return {records.begin(), records.end()};
}

TEST(Views, OfManyWallsAreFoundAsOfFew) {
  Random random(3);
  std::vector<WallViews> walls;
  for (int i = 0; i < 12; ++i)
    for (const WallViews& wall : boxRoom(random.from(0.5, 3), {0.1, random.sizeFrom(5, 200)}))
      walls.push_back(wall);
  ASSERT_EQ(walls.size(), 72U);
  test::Frames f;
  f.viewer.set({random.within(30), random.turned()}, {random.within(0.2), random.turned()});
  ChangeSet c;
  c.chunks = {{f.state.arena().add(boxesAbout(random, 3000, 1)), true}};
  for (std::uint32_t i = 0; i < 300; ++i) c.instances.push_back({i, test::thing(random.within(30), 0.5)});
  const SlotView state = f.publish(c);
  RoomCull room(walls);
  const RoomCull::Visibility seen = room.visibleIn(state);
  std::size_t found = 0;
  for (std::size_t wall = 0; wall < walls.size(); ++wall) {
    const auto records = setOf(seen.on(wall).records);
    EXPECT_EQ(records, setOf(test::simplySeen(state, walls[wall]))) << "wall " << wall;
    EXPECT_EQ(records.size(), seen.on(wall).records.size()) << "none twice";
    found += records.size();
  }
  EXPECT_GT(found, 1000U);
}

TEST(Views, OfOneWallThroughSeveralScreensAreFoundTogetherAndNoneTwice) {
  Random random(4);
  std::vector<WallViews> walls = boxRoom(1.5, {0.1, 60});
  for (WallViews& wall : walls) wall.views = viewsOf(wall.views[0].screen, false);
  test::Frames f;
  ChangeSet c;
  c.chunks = {{f.state.arena().add(boxesAbout(random, 3000, 1)), true}};
  const SlotView state = f.publish(c);
  std::set<const InstanceRecord*> expected;
  for (const WallViews& wall : walls) expected.merge(setOf(test::simplySeen(state, wall)));
  // Six walls of six screens: a search ends between two walls, not within one.
  RoomCull room(std::vector<WallViews>(6, allIn(walls)));
  const RoomCull::Visibility seen = room.visibleIn(state);
  for (std::size_t wall = 0; wall < 6; ++wall) {
    EXPECT_EQ(setOf(seen.on(wall).records), expected);
    EXPECT_EQ(seen.on(wall).records.size(), expected.size()) << "none twice";
  }
}

TEST(Views, AreSeenFromTheirEyeAndSwappedOnDemand) {
  WallViews wall = boxRoom(1.5, {0.1, 60})[0];
  wall.eyeSeparation = 0.1;
  wall.views.push_back({wall.views[0].screen, ViewPoint::Middle});
  const PlacedViews placed = place({}, wall, {}), swapped = place({}, wall, {.swapped = true});
  ASSERT_EQ(placed.count, 3U);
  const double height = ViewerRecord{}.headPosition[2];
  EXPECT_EQ(placed.views[0].eye, Vec3(-0.05, 0, height));
  EXPECT_EQ(placed.views[1].eye, Vec3(0.05, 0, height));
  EXPECT_EQ(placed.views[2].eye, Vec3(0, 0, height));
  EXPECT_EQ(swapped.views[0].eye, placed.views[1].eye);
  EXPECT_EQ(swapped.views[1].eye, placed.views[0].eye);
  EXPECT_EQ(swapped.views[2].eye, placed.views[2].eye);
  EXPECT_EQ(place({}, wall, {.separation = 0.2}).views[1].eye, Vec3(0.1, 0, height));
  EXPECT_EQ(placed.endOfScreen(0), 3U);
}

TEST(PictureViews, OfOneWallAreThePicturesOfWallsWithOneViewEach) {
  Random random(5);
  MeshStore meshes;
  auto maker = test::MeshMaker(test::matt(0.2f, 0.6f, 0.5f));
  const MeshId box = meshes.add(maker.box(Vec3(-1, -1, -1), Vec3(1, 1, 1)).seal());
  std::vector<WallViews> walls = boxRoom(1.5, {0.1, 100});
  for (WallViews& wall : walls) {
    wall.views = viewsOf(wall.views[0].screen, false);
    wall.width = 64, wall.height = 48;
  }
  test::Frames f;
  ChangeSet c;
  c.chunks = {{f.state.arena().add(boxesAbout(random, 1000, box)), true}};
  c.lightsChanged = true, c.lights.resize(1);
  const SlotView state = f.publish(c);
  auto provider = test::provider(GlProviderKind::OsMesa);
  ASSERT_TRUE(provider);
  auto target = provider->create(64, 48);
  ASSERT_TRUE(target && !target.value()->makeCurrent());
  for (const RenderQuality quality : {RenderQuality::plain(), RenderQuality{}}) {
    auto made = GlRenderer::create(target.value()->gl(), target.value()->turns(), meshes, 64, 48, quality);
    ASSERT_TRUE(made);
    GlRenderer& renderer = *made.value();
    const bool oneSample = quality.samples == 1;
    RoomCull together({allIn(walls)}), apart(walls);
    DrawList list;
    WallCull({.room = together, .oneSample = oneSample}, 0).fill(state, {}, list);
    ASSERT_EQ(list.viewCount, 6U);
    ASSERT_FALSE(renderer.draw(list));
    std::vector<std::vector<std::uint8_t>> pictures(6, std::vector<std::uint8_t>(64 * 48 * 4));
    for (std::uint32_t v = 0; v < 6; ++v) ASSERT_FALSE(renderer.read(v, pictures[v]));
    for (std::uint32_t v = 0; v < 6; ++v) {
      DrawList one;
      WallCull({.room = apart, .oneSample = oneSample}, v).fill(state, {}, one);
      std::vector<std::uint8_t> picture(64 * 48 * 4);
      ASSERT_FALSE(renderer.draw(one) || renderer.read(0, picture));
      EXPECT_EQ(pictures[v], picture) << "view " << v;
      EXPECT_EQ(renderer.totals()[v].frames, v == 0 ? 2U : 1U);
    }
  }
}

}  // namespace
}  // namespace stadion
