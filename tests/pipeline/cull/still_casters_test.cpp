#include "pipeline/cull/still_casters.h"

#include <gtest/gtest.h>
#include <random>

namespace stadion {
namespace {

InstanceRecord thing(double x, std::uint32_t mesh = 1) {
  InstanceRecord r{};
  r.model[0] = r.model[5] = r.model[10] = 1;
  r.model[3] = r.centre[0] = x;
  r.radius = 1, r.mesh = mesh, r.flags = InstanceRecord::kShown;
  return r;
}

RingPlace ringAt(double x, std::size_t ring = 0) {
  RingPlace place;
  place.ring = ring, place.centre_L = place.centre_W = Vec3(x, 0, 0);
  return place;
}

/// Plays changes into the slots in turn, as a show does.
struct CasterFrames {
  SceneState state;
  StillCasters casters;
  std::size_t frame = 0;

  SlotView publish(const ChangeSet& changes) {
    const std::size_t slot = frame++ % kSlots;
    state.publish(slot, changes);
    return state.view(slot);
  }
};

TEST(StillCasters, AreFoundOnceForAllWallsAndAllFramesInWhichNothingOfThemChanges) {
  CasterFrames f;
  const std::vector<InstanceRecord> records{thing(0), thing(2), thing(1000)};
  ChangeSet c;
  c.chunks = {{f.state.arena().add(records), true}};
  c.instances = {{0, thing(3)}, {1, thing(4)}};
  f.publish(c);
  c.clear();
  c.instances = {{1, thing(4.1)}};  // from here on it has moved
  const auto first = f.casters.at(ringAt(0), f.publish(c)).items;
  EXPECT_EQ(first->size(), 3u);
  for (int frame = 0; frame < 10; ++frame) {
    c.instances = {{1, thing(4.1 + frame)}};
    const SlotView view = f.publish(c);
    for (int wall = 0; wall < 4; ++wall) EXPECT_EQ(f.casters.at(ringAt(0), view).items, first);
  }
  EXPECT_NE(f.casters.at(ringAt(1), f.publish(c)).items, first) << "the ring has moved";
}

TEST(StillCasters, WhatIsSeenThroughFromNowOnCastsNoShadow) {
  CasterFrames f;
  ChangeSet c;
  c.instances = {{0, thing(0)}, {1, thing(2)}};
  EXPECT_EQ(f.casters.at(ringAt(0), f.publish(c)).items->size(), 2u);
  c.instances = {{1, thing(2)}};
  c.instances[0].record.flags |= 3U << InstanceRecord::kPaintAt;
  EXPECT_EQ(f.casters.at(ringAt(0), f.publish(c)).items->size(), 2u) << "only its colour is another one";
  c.instances[0].record.flags |= InstanceRecord::kTransparent;
  EXPECT_EQ(f.casters.at(ringAt(0), f.publish(c)).items->size(), 1u);
}

TEST(StillCasters, AreWhatStandsStillInThatFrameWhateverComesGoesAndBeginsToMove) {
  CasterFrames f;
  std::mt19937 random(11);
  const auto below = [&](std::uint32_t n) { return static_cast<std::uint32_t>(random() % n); };
  const auto place = [&] { return 0.1 * below(100) - 5; };
  std::vector<ChunkId> chunks;
  for (int i = 0; i < 4; ++i) {
    std::vector<InstanceRecord> records;
    for (int k = 0; k < 70; ++k) records.push_back(thing(place(), 1 + below(5)));
    chunks.push_back(f.state.arena().add(records));
  }
  std::vector<bool> shown(chunks.size());
  int changed = 0;
  const std::vector<DrawItem>* before = nullptr;
  for (int i = 0; i < 1000; ++i) {
    ChangeSet c;
    if (below(6) == 0) {
      const InstanceId id = below(20);
      InstanceRecord r = thing(place());
      if (below(3) == 0) r.radius = -1;
      c.instances = {{id, r}};
    }
    const std::uint32_t which = below(4);
    if (below(20) == 0) {
      shown[which] = !shown[which];
      c.chunks = {{chunks[which], shown[which]}};
    } else if (below(20) == 0 && shown[which]) {
      c.statics = {{chunks[which], below(70), true}};
    }
    const SlotView view = f.publish(c);
    StillCasters emptyCasters;
    for (const std::size_t ring : {0u, 2u}) {
      const RingPlace at = ringAt(0, ring);
      const RingCasters known = f.casters.at(at, view), fresh = emptyCasters.at(at, view);
      ASSERT_EQ(known.key, fresh.key) << "frame " << i;
      ASSERT_EQ(known.items->size(), fresh.items->size());
      for (std::size_t k = 0; k < fresh.items->size(); ++k) {
        ASSERT_EQ((*known.items)[k].model, (*fresh.items)[k].model);
        ASSERT_EQ((*known.items)[k].mesh, (*fresh.items)[k].mesh);
      }
      if (ring == 0) changed += known.items.get() != std::exchange(before, known.items.get());
    }
  }
  EXPECT_GT(changed, 50);
  EXPECT_LT(changed, 400) << "what moves on changes nothing here";
}

TEST(StillCasters, AFrameThatIsOverwrittenMeanwhileIsNotKeptForOthers) {
  CasterFrames f;
  ChangeSet c;
  c.instances = {{0, thing(0)}};
  const SlotView view = f.publish(c);
  EXPECT_TRUE(view.intact());
  f.state.publish(view.slot, ChangeSet{});
  EXPECT_FALSE(view.intact());
  const auto broken = f.casters.at(ringAt(0), view).items;
  EXPECT_NE(f.casters.at(ringAt(0), f.state.view(view.slot)).items, broken);
}

}  // namespace
}  // namespace stadion
