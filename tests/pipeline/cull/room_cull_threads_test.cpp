/// Walls come to the room's Cull when they like.

#include "pipeline/state/frame_slots.h"
#include "tests/pipeline/cull/cull_room.h"

#include <gtest/gtest.h>
#include <thread>

namespace stadion {
namespace {

using test::Random;
using test::thing;

TEST(ThreadsRoomCull, EachWallGetsEveryFramesListAndAMissingWallDelaysNoOther) {
  constexpr std::size_t kWalls = 4, kFrames = 200;
  const std::vector<WallViews> views = test::boxRoom(1.5, {0.1, 40});
  SceneState state;
  RoomCull room(views);
  FrameSlots slots(kWalls, Delivery::Every);
  Random random(12);
  std::vector<InstanceRecord> records;
  for (std::uint32_t i = 0; i < 3000; ++i)
    records.push_back(thing(random.within(40), 0.5, 1 + i % 5, {1, i}));
  const ChunkId chunk = state.arena().add(records);
  std::array<std::size_t, kWalls> frames{};
  std::vector<std::thread> threads;
  for (std::uint32_t wall = 0; wall < kWalls; ++wall)
    threads.emplace_back([&, wall] {
      WallCull cull({room}, wall);
      DrawList list;
      while (const auto lease = slots.lease(wall)) {
        const SlotView view = state.view(lease->slot);
        // Some frames pass a wall by: its picture is not wanted, or it has been replaced.
        if ((lease->ticket.signature.frame + wall) % 5 != 0) {
          cull.fill(view, {}, list);
          EXPECT_EQ(list.opaque.size(), test::simplyFilled(view, views[wall]).opaque.size());
        }
        EXPECT_TRUE(slots.release(*lease));
        ++frames[wall];
      }
    });
  ChangeSet c;
  c.chunks = {{chunk, true}};
  for (std::uint64_t frame = 0; frame < kFrames; ++frame) {
    const auto slot = slots.beginWrite();
    ASSERT_TRUE(slot);
    c.signature.frame = frame;
    c.viewer.set({random.within(20), random.turned()}, test::headIn(1.5, random));
    for (InstanceId id = 0; id < 100; ++id) c.instances.push_back({id, thing(random.within(20), 0.2)});
    state.publish(*slot, c);
    FrameTicket ticket;
    ticket.signature = c.signature;
    slots.endWrite(*slot, ticket);
    c = {};
  }
  slots.finish();
  for (std::thread& t : threads) t.join();
  for (const std::size_t n : frames) EXPECT_EQ(n, kFrames);
}

}  // namespace
}  // namespace stadion
