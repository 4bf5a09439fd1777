#include "engine/asset/mesh_store.h"

#include <atomic>
#include <gtest/gtest.h>
#include <thread>

namespace stadion {
namespace {

std::unique_ptr<Mesh> meshWith(std::uint64_t hash) {
  auto mesh = std::make_unique<Mesh>();
  mesh->hash = hash;
  return mesh;
}

TEST(MeshStore, AnIdFollowsFromTheContentWheneverMemoryWasFreed) {
  const auto idsOf = [](bool collectEarly) {
    MeshStore store;
    std::vector<MeshId> ids;
    for (std::uint64_t round = 0; round < 3; ++round)
      for (const std::uint64_t hash : {0x1234567890ULL, 0xABCDEF0123456ULL, 0xABCDEF0123456ULL, 7ULL}) {
        ids.push_back(store.add(meshWith(hash)));
        store.release(ids.back(), round);
        if (collectEarly) store.collect(round);
      }
    return ids;
  };
  EXPECT_EQ(idsOf(true), idsOf(false));
}

TEST(MeshStore, DifferentMeshesHaveDifferentIdsAlsoWhereTheirHashesMeet) {
  MeshStore store;
  const MeshId a = store.add(meshWith(1)), b = store.add(meshWith(std::uint64_t{1} << 32)),
               c = store.add(meshWith(0)), again = store.add(meshWith(1));
  EXPECT_NE(a, b);
  EXPECT_NE(a, c);
  EXPECT_NE(b, c);
  EXPECT_NE(c, kNoMesh);
  EXPECT_EQ(a, again);
  EXPECT_EQ(store.find(b)->hash, std::uint64_t{1} << 32);
}

TEST(MeshStore, CountsWhatItFreed) {
  MeshStore store;
  const MeshId a = store.add(meshWith(1));
  EXPECT_EQ(store.freedCount(), 0u);
  store.release(a, 5);
  store.collect(4);
  EXPECT_EQ(store.freedCount(), 0u);
  EXPECT_TRUE(store.find(a));
  store.collect(5);
  EXPECT_EQ(store.freedCount(), 1u);
  EXPECT_FALSE(store.find(a));
}

// A wall that looked through its meshes once read one that App was just freeing.
TEST(ThreadsMeshStore, AskingWhetherAMeshIsThereNeedsNoneThatIsGoing) {
  MeshStore store;
  std::atomic<bool> over = false;
  std::thread wall([&] {
    while (!over) (void)store.holds(1, 1);
  });
  std::uint64_t held = 0;
  for (std::uint64_t frame = 0; frame < 2000; ++frame) {
    const MeshId id = store.add(meshWith(1));
    ASSERT_EQ(id, 1u);
    held += store.holds(id, 1) && !store.holds(id, 2);
    store.release(id, frame);
    store.collect(frame);
    EXPECT_FALSE(store.holds(id, 1));
  }
  over = true;
  wall.join();
  EXPECT_EQ(held, 2000u);
}

}  // namespace
}  // namespace stadion
