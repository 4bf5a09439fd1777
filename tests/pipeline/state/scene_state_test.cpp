#include "pipeline/state/scene_state.h"

#include <gtest/gtest.h>
#include <random>

namespace stadion {
namespace {

ChangeSet::Instance instance(InstanceId id, double value) {
  ChangeSet::Instance i{id, {}};
  i.record.model[3] = value;
  i.record.radius = 1;
  return i;
}

TEST(SceneState, ASlotThatMissedFramesCatchesUp) {
  SceneState state;
  ChangeSet c;
  c.instances = {instance(0, 1), instance(5, 2)};
  state.publish(0, c);
  c.instances = {instance(5, 3)};
  state.publish(1, c);
  c.instances = {instance(7, 4)};
  state.publish(2, c);
  const SlotView v = state.view(2);
  ASSERT_EQ(v.instances.size(), 8u);
  EXPECT_EQ(v.instances[0].model[3], 1);
  EXPECT_EQ(v.instances[5].model[3], 3);
  EXPECT_EQ(v.instances[7].model[3], 4);
  EXPECT_LT(v.instances[6].radius, 0);
  EXPECT_EQ(state.view(0).instances[5].model[3], 2) << "a slot keeps its frame until it is written again";
}

TEST(SceneState, EverySlotHoldsWhatASingleCopyWouldHold) {
  SceneState state;
  std::mt19937 random(7);
  std::vector<double> expected(200, 0);
  std::vector<bool> there(200, false);
  for (int frame = 0; frame < 500; ++frame) {
    ChangeSet c;
    for (std::uint32_t n = random() % 6; n > 0; --n) {
      const InstanceId id = random() % 200;
      const bool twice =
          std::any_of(c.instances.begin(), c.instances.end(), [&](auto& i) { return i.id == id; });
      if (twice) continue;
      expected[id] = frame, there[id] = true;
      c.instances.push_back(instance(id, frame));
    }
    const std::size_t slot = random() % kSlots;
    if (frame % 2 == 0) {
      state.publish(slot, c);
    } else {  // the same, some of it before the rest
      const std::size_t before = random() % (c.instances.size() + 1);
      state.begin(slot);
      state.take(std::span(c.instances).first(before));
      c.instances.erase(c.instances.begin(), c.instances.begin() + static_cast<std::ptrdiff_t>(before));
      state.finish(c);
    }
    const SlotView v = state.view(slot);
    for (InstanceId id = 0; id < v.instances.size(); ++id) {
      ASSERT_EQ(v.instances[id].radius > 0, there[id]);
      if (there[id]) {
        ASSERT_EQ(v.instances[id].model[3], expected[id]) << "frame " << frame;
      }
    }
  }
}

TEST(SceneState, PaintsReachEverySlot) {
  SceneState state;
  ChangeSet c;
  c.paintsChanged = true;
  c.paints = {{{1, 0, 0}, 0.5f, {0, 0, 1}}, {}};
  state.publish(0, c);
  const ChangeSet none;
  state.publish(1, none);
  state.publish(2, none);
  for (std::size_t slot = 0; slot < kSlots; ++slot) {
    const auto paints = state.view(slot).paints;
    EXPECT_EQ(std::vector(paints.begin(), paints.end()), c.paints) << slot;
  }
}

TEST(SceneState, AReaderOfASlotThatIsWrittenFindsOutAlsoAfterAFrameThatWasGivenUp) {
  SceneState state;
  ChangeSet c;
  c.instances = {instance(0, 1)};
  state.publish(0, c);
  const SlotView before = state.view(0);
  EXPECT_TRUE(before.intact());
  state.begin(0);  // and is given up
  EXPECT_FALSE(before.intact());
  EXPECT_FALSE(state.view(0).intact());
  state.begin(0);
  state.take(c.instances);
  EXPECT_FALSE(before.intact());
  EXPECT_FALSE(state.view(0).intact());
  const std::uint32_t stamp = before.stamps[0];
  state.finish(ChangeSet{});
  EXPECT_FALSE(before.intact());
  EXPECT_TRUE(state.view(0).intact());
  state.publish(0, c);
  EXPECT_NE(state.view(0).stamps[0], stamp);
}

TEST(SceneState, PublishingCostsWhatChangedNotWhatExists) {
  SceneState state;
  ChangeSet all;
  for (InstanceId id = 0; id < 10000; ++id) all.instances.push_back(instance(id, 0));
  for (std::size_t slot = 0; slot < kSlots; ++slot) state.publish(slot, slot == 0 ? all : ChangeSet{});
  ChangeSet few;
  for (InstanceId id = 0; id < 10; ++id) few.instances.push_back(instance(id, 1));
  for (std::size_t frame = 0; frame < 9; ++frame) EXPECT_LE(state.publish(frame % kSlots, few), 20u);
}

TEST(SceneState, ChunksAreStoredOnceAndShownAndHiddenBySlot) {
  SceneState state;
  std::vector<InstanceRecord> records(130);
  records[129].mesh = 42;
  const ChunkId chunk = state.arena().add(records);
  ChangeSet c;
  c.chunks = {{chunk, true}};
  state.publish(0, c);
  ASSERT_EQ(state.view(0).chunks.size(), 1u);
  EXPECT_EQ(state.view(0).chunk(chunk).records[129].mesh, 42u);
  EXPECT_EQ(state.view(1).chunks.size(), 0u);
  c = {};
  c.statics = {{chunk, 129, true}};
  state.publish(1, c);
  EXPECT_EQ(state.view(0).chunk(chunk).hidden[2], 0u);
  EXPECT_EQ(state.view(1).chunk(chunk).hidden[2], 2u);
  state.publish(2, {});
  EXPECT_EQ(state.view(2).chunk(chunk).hidden[2], 2u);
  c = {};
  c.chunks = {{chunk, false}};
  state.publish(0, c);
  EXPECT_TRUE(state.view(0).chunks.empty());
}

TEST(SceneState, WhatIsNotedForSlotsThatAreNeverWrittenDoesNotGrow) {
  SceneState state;
  const std::vector<InstanceRecord> records(100);
  std::size_t most = 0;
  for (int round = 0; round < 200; ++round) {  // a sub-scene comes, all its objects move, it goes
    const ChunkId chunk = state.arena().add(records);
    ChangeSet c;
    c.chunks = {{chunk, true}};
    for (std::uint32_t i = 0; i < 100; ++i) {
      c.statics.push_back({chunk, i, true});
      c.instances.push_back(instance(i, round));
    }
    state.publish(0, c);
    c = {};
    c.chunks = {{chunk, false}};
    state.publish(0, c);
    state.arena().free(chunk);
    most = std::max(most, state.noted());
  }
  EXPECT_LE(most, 200u);
  EXPECT_TRUE(state.view(0).chunks.empty());
}

TEST(ChunkArena, GivesFreedRoomToTheNextChunk) {
  ChunkArena arena;
  std::vector<InstanceRecord> records(1000);
  const ChunkId first = arena.add(records);
  const std::size_t bytes = arena.bytesInUse();
  for (int i = 0; i < 100; ++i) {
    const ChunkId a = arena.add(records), b = arena.add(records);
    const auto* at = arena.find(a, 0).records.data();
    arena.free(a);
    const ChunkId again = arena.add(records);
    EXPECT_EQ(arena.find(again, 0).records.data(), at);
    arena.free(again), arena.free(b);
  }
  EXPECT_EQ(arena.bytesInUse(), bytes);
  EXPECT_EQ(arena.find(first, 0).records.size(), 1000u);
  EXPECT_TRUE(arena.find(9999, 0).records.empty());
}

}  // namespace
}  // namespace stadion
