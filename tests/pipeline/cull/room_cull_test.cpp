/// The room's Cull finds what looking at every record would find, for all walls at once.

#include "tests/pipeline/cull/cull_room.h"

#include <cstring>
#include <gtest/gtest.h>
#include <set>

namespace stadion {
namespace {

using test::boxRoom;
using test::Frames;
using test::headIn;
using test::Random;
using test::thing;

std::vector<const InstanceRecord*> sorted(std::vector<const InstanceRecord*> records) {
  std::ranges::sort(records);
  return records;
}

void expectAsSimple(RoomCull& room, const SlotView& state, const std::vector<WallViews>& views) {
  const RoomCull::Visibility seen = room.visibleIn(state);
  for (std::size_t wall = 0; wall < views.size(); ++wall)
    ASSERT_EQ(sorted(seen.on(wall).records), sorted(test::simplySeen(state, views[wall])))
        << "wall " << wall << ", frame " << state.signature->frame;
}

/// Spheres of all sizes about a place, some of them odd.
std::vector<InstanceRecord> things(Random& random, std::uint32_t count, const Vec3& about, double spread) {
  std::vector<InstanceRecord> records;
  for (std::uint32_t i = 0; i < count; ++i) {
    const double radius = random.below(50) == 0 ? random.sizeFrom(10, 1e4) : random.sizeFrom(1e-3, 3);
    records.push_back(thing(about + random.within(spread), radius, 1 + random.below(4), {1, i}));
    InstanceRecord& r = records.back();
    if (random.below(20) == 0) r.flags |= InstanceRecord::kTransparent;
    if (random.below(20) == 0) r.flags &= ~InstanceRecord::kShown;
    if (random.below(200) == 0) r.centre[random.below(3)] = random.below(2) ? NAN : INFINITY;
    if (random.below(200) == 0) r.radius = INFINITY;
  }
  return records;
}

TEST(RoomCull, FindsWhatLookingAtEveryRecordFinds) {
  Random random(1);
  std::size_t seen = 0;
  for (int round = 0; round < 60; ++round) {
    const double half = random.from(0.5, 3), spread = random.sizeFrom(2, 2000);
    const Vec3 rig = round % 3 == 0 ? random.within(1e6) : random.within(30);
    const std::vector<WallViews> views = boxRoom(half, {0.1, random.sizeFrom(5, 2000)});
    RoomCull room(views);
    Frames f;
    f.viewer.set({rig, random.turned()}, headIn(half, random));
    ChangeSet c;
    for (const std::uint32_t count : {0U, 1U, 7U, 8U, 9U, 65U, 700U, 3000U})
      c.chunks.push_back({f.state.arena().add(things(random, count, rig, spread)), true});
    // Measured from far away, single precision is off by centimetres.
    std::vector<InstanceRecord> apart = things(random, 1000, rig, spread);
    for (const InstanceRecord& r : things(random, 1100, rig + Vec3(1e6, 1e6, 0), spread)) apart.push_back(r);
    c.chunks.push_back({f.state.arena().add(apart), true});
    for (const InstanceRecord& r : things(random, 500, rig, spread))
      c.instances.push_back({static_cast<InstanceId>(c.instances.size()), r});
    const SlotView state = f.publish(c);
    ASSERT_NO_FATAL_FAILURE(expectAsSimple(room, state, views)) << "round " << round;
    const RoomCull::Visibility all = room.visibleIn(state);
    for (std::size_t wall = 0; wall < views.size(); ++wall) seen += all.on(wall).records.size();
  }
  EXPECT_GT(seen, 10000U);
}

TEST(RoomCull, FollowsWhatMovesComesGoesAndLeavesItsChunk) {
  Random random(2);
  const std::vector<WallViews> views = boxRoom(1.5, {0.1, 60});
  RoomCull room(views);
  Frames f;
  std::vector<ChunkId> chunks;
  for (int i = 0; i < 3; ++i) chunks.push_back(f.state.arena().add(things(random, 300, Vec3::Zero(), 40)));
  std::vector<bool> shown(chunks.size());
  std::uint32_t most = 3;
  for (int frame = 0; frame < 600; ++frame) {
    ChangeSet c;
    if (random.below(10) == 0) most += random.below(100);
    std::set<InstanceId> changed;
    for (std::uint32_t n = random.below(20); n > 0; --n) changed.insert(random.below(most));
    for (const InstanceId id : changed) {
      c.instances.push_back({id, things(random, 1, Vec3::Zero(), 40)[0]});
      if (random.below(5) == 0) c.instances.back().record.radius = -1;
    }
    const std::uint32_t which = random.below(3);
    if (random.below(20) == 0) {
      shown[which] = !shown[which];
      c.chunks = {{chunks[which], shown[which]}};
    } else if (shown[which]) {
      c.statics = {{chunks[which], random.below(300), random.below(2) == 0}};
    }
    if (random.below(100) == 0) {  // a file goes, another one comes into its room
      if (shown[which]) c.chunks = {{chunks[which], false}}, c.statics.clear();
      for (std::size_t slot = 0; slot < kSlots; ++slot) f.publish(c);
      f.state.arena().free(chunks[which]);
      chunks[which] = f.state.arena().add(things(random, 300, Vec3::Zero(), 40));
      shown[which] = false, c = {};
    }
    // The rig goes far now and then, so that what moves is measured from elsewhere.
    const Vec3 rig = random.below(30) == 0 ? random.within(1e5) : random.within(20);
    f.viewer.set({rig, random.turned()}, headIn(1.5, random));
    const SlotView state = f.publish(c);
    if (random.below(4) == 0) continue;  // this frame is not culled
    ASSERT_NO_FATAL_FAILURE(expectAsSimple(room, state, views));
  }
}

TEST(RoomCull, OnEveryProcessorItFindsTheSameWithTheSameTests) {
  if (!__builtin_cpu_supports("avx2")) GTEST_SKIP() << "no AVX2";
  Random random(3);
  for (int round = 0; round < 40; ++round) {
    const std::vector<WallViews> views = boxRoom(1.5, {0.1, random.sizeFrom(5, 500)});
    Frames f;
    f.viewer.set({random.within(50), random.turned()}, headIn(1.5, random));
    ChangeSet c;
    c.chunks = {{f.state.arena().add(things(random, 2000, Vec3::Zero(), 100)), true}};
    for (const InstanceRecord& r : things(random, 300, Vec3::Zero(), 100))
      c.instances.push_back({static_cast<InstanceId>(c.instances.size()), r});
    const SlotView state = f.publish(c);
    RoomCull four(views, kFourBounds), eight(views, kEightBounds);
    const RoomCull::Visibility a = four.visibleIn(state), b = eight.visibleIn(state);
    for (std::size_t wall = 0; wall < views.size(); ++wall) {
      ASSERT_EQ(a.on(wall).records, b.on(wall).records);
      ASSERT_EQ(a.on(wall).tested, b.on(wall).tested);
    }
  }
}

TEST(RoomCull, EveryBitOfTheTestsIsTheSameOnEveryProcessor) {
  if (!__builtin_cpu_supports("avx2")) GTEST_SKIP() << "no AVX2";
  Random random(4);
  for (int round = 0; round < 200; ++round) {
    std::array<VolumePlanes, 32> volumes{};
    for (VolumePlanes& v : volumes) {
      v.count = 1 + random.below(8);
      for (unsigned p = 0; p < v.count; ++p) {
        const Vec3 n = random.turned() * Vec3::UnitX();
        for (int k = 0; k < 3; ++k) v.normal[p][k] = random.below(8) == 0 ? 0 : static_cast<float>(n[k]);
        v.offset[p] = static_cast<float>(random.from(-1, 5));
        v.rounding[p] = kRounding * std::abs(v.offset[p]);
      }
    }
    std::vector<float> bounds(48 * 4);
    for (float& x : bounds) x = static_cast<float>(random.from(-3, 3));
    for (unsigned i = 0; i < 8; ++i) bounds[random.below(48 * 4)] = random.below(2) ? INFINITY : -INFINITY;
    const std::array<TreeGroup, 3> in{{{2, ~0U, 0}, {0, random.below(~0U), 0}, {3, 0x0f, 0xf0}}};
    std::array<TreeGroup, 24> groups[2]{};
    std::array<TreeSphere, 24> spheres[2]{};
    unsigned long long tested[2][32]{};
    unsigned counts[2][2];
    for (const int k : {0, 1}) {
      const BoundsKernels& kernels = k ? kEightBounds : kFourBounds;
      counts[k][0] =
          kernels.boxes(bounds.data(), 29, volumes.data(), in.data(), 3, groups[k].data(), tested[k]);
      counts[k][1] =
          kernels.spheres(bounds.data(), 29, volumes.data(), in.data(), 3, spheres[k].data(), tested[k]);
    }
    EXPECT_TRUE(std::ranges::equal(counts[0], counts[1]) && std::ranges::equal(tested[0], tested[1]));
    EXPECT_EQ(0, std::memcmp(&groups[0], &groups[1], sizeof groups[0])) << "round " << round;
    EXPECT_EQ(0, std::memcmp(&spheres[0], &spheres[1], sizeof spheres[0])) << "round " << round;
  }
}

TEST(RoomCull, CostsWhatIsSeenNotWhatExists) {
  Random random(5);
  const std::vector<WallViews> views = boxRoom(1.5, {0.1, 25});
  std::vector<std::uint64_t> tested;
  for (const std::uint32_t count : {2000U, 200'000U}) {  // as dense
    Frames f;
    const double spread = 12 * std::cbrt(count / 2000.0);
    std::vector<InstanceRecord> records;
    for (std::uint32_t i = 0; i < count; ++i) records.push_back(thing(random.within(spread), 0.15));
    ChangeSet c;
    c.chunks = {{f.state.arena().add(records), true}};
    RoomCull room(views);
    const RoomCull::Visibility seen = room.visibleIn(f.publish(c));
    tested.push_back(0);
    for (std::size_t wall = 0; wall < views.size(); ++wall) tested.back() += seen.on(wall).tested;
  }
  EXPECT_LT(tested[1], 20 * tested[0]) << "of a hundred times as much";
}

TEST(RoomCull, SearchesOnceForAllWallsOfAFrame) {
  const std::vector<WallViews> views = boxRoom(1.5, {0.1, 25});
  RoomCull room(views);
  Frames f;
  ChangeSet c;
  c.instances = {{0, thing({0, 5, 0}, 1)}};
  const SlotView state = f.publish(c);
  const RoomCull::Visibility first = room.visibleIn(state), second = room.visibleIn(state);
  EXPECT_EQ(&first.on(0), &second.on(0));
  const RoomCull::Visibility next = room.visibleIn(f.publish({}));
  EXPECT_NE(&first.on(0), &next.on(0)) << "another frame";
}

TEST(RoomCull, AFrameThatIsOverwrittenMeanwhileIsNotKeptForOthers) {
  const std::vector<WallViews> views = boxRoom(1.5, {0.1, 25});
  RoomCull room(views);
  Frames f;
  ChangeSet c;
  c.instances = {{0, thing({0, 5, 0}, 1)}};
  const SlotView late = f.publish(c);
  const RoomCull::Visibility before = room.visibleIn(late);
  ASSERT_EQ(before.on(0).records.size(), 1U);
  c.instances = {{0, thing({0, -5, 0}, 1)}};
  f.state.publish(late.slot, c);
  const RoomCull::Visibility broken = room.visibleIn(late), now = room.visibleIn(f.state.view(late.slot));
  EXPECT_EQ(&broken.on(0), &before.on(0)) << "what it has found it keeps";
  EXPECT_NE(&now.on(0), &before.on(0));
  EXPECT_EQ(now.on(0).records.size(), 0U);
  EXPECT_EQ(now.on(4).records.size(), 1U);

  // A view from before, asked for after: void, and not given to others.
  RoomCull other(views);
  const RoomCull::Visibility voided = other.visibleIn(late), good = other.visibleIn(f.state.view(late.slot));
  EXPECT_NE(&voided.on(0), &good.on(0));
  EXPECT_EQ(good.on(4).records.size(), 1U);
}

/// Looks where it is told, if at all.
class Camera final : public FreeCamera {
public:
  std::optional<CameraView> view() const override {
    ++asked;
    if (!on) return std::nullopt;
    CameraView from;
    from.eye = eye;
    from.screen = test::wallOf(eye + Vec3(-1, 1, -1), eye + Vec3(1, 1, -1), eye + Vec3(-1, 1, 1));
    return from;
  }
  void addTo(std::vector<InstanceRecord>& records, const ViewerRecord&) const override {
    records.push_back(thing(eye + Vec3(0, 2, 0), 0.1, 77));
  }

  bool on = true;
  Vec3 eye = Vec3::Zero();
  mutable int asked = 0;
};

TEST(RoomCull, AFreeCameraIsOneMoreView) {
  Camera camera;
  std::vector<WallViews> views = boxRoom(1.5, {0.1, 25});
  WallViews overview;
  overview.views = {View{}}, overview.camera = &camera, overview.depth = {0.1, 25};
  views.push_back(overview);
  RoomCull room(views);
  WallCull cull({room}, 6);
  Frames f;
  ChangeSet c;
  c.instances = {{0, thing({100, 5, 0}, 1)}};
  camera.eye = Vec3(100, 0, 0);
  DrawList list;
  cull.fill(f.publish(c), {}, list);
  EXPECT_EQ(list.viewCount, 1U);
  ASSERT_EQ(list.opaque.size(), 2U) << "the thing, and what only the camera sees";
  EXPECT_EQ(list.opaque[1].mesh, 77U);
  EXPECT_EQ(camera.asked, 1) << "it may move meanwhile";
  camera.on = false;
  cull.fill(f.publish({}), {}, list);
  EXPECT_EQ(list.viewCount, 0U);
  EXPECT_TRUE(list.opaque.empty());
}

}  // namespace
}  // namespace stadion
