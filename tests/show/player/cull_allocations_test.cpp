/// Once it has seen the show, Cull asks for no memory.

#include "profiling/record/allocations.h"
#include "tests/pipeline/cull/cull_room.h"

#include <gtest/gtest.h>

namespace stadion {
namespace {

using test::Random;
using test::thing;

/// A mesh with a simplified level.
MeshId meshWithLevels(MeshStore& meshes) {
  auto mesh = std::make_unique<Mesh>();
  mesh->materials.emplace_back();
  mesh->bounds = {Vec3::Constant(-1), Vec3::Constant(1)};
  mesh->sphere = {Vec3::Zero(), 1};
  mesh->levels.resize(1);
  mesh->levels[0].error = 0.01;
  mesh->hash = 5;
  return meshes.add(std::move(mesh));
}

TEST(ProgramCullAllocations, InSteadyStateThereAreNone) {
  if (!countsAllocations()) GTEST_SKIP() << "a sanitizer counts its own";
  Random random(13);
  MeshStore meshes;
  const MeshId mesh = meshWithLevels(meshes);
  const std::vector<WallViews> views = test::boxRoom(1.5, {0.1, 40});
  std::vector<WallPixels> pixels;
  for (const WallViews& view : views) pixels.push_back({view.views[0].screen, view.width, view.height});
  RoomCull room(views);
  StillCasters still;
  std::vector<WallCull> culls;
  for (std::uint32_t wall = 0; wall < views.size(); ++wall)
    culls.emplace_back(CullParts{room, &still, pixels, &meshes}, wall);

  test::Frames f;
  ChangeSet c;
  std::vector<InstanceRecord> records;
  for (std::uint32_t i = 0; i < 5000; ++i) {
    records.push_back(thing(random.within(40), 0.5, i % 3 ? 1 + i % 7 : mesh, {1, i}));
    records.back().lodFactor = i % 3 ? 0.0f : 1.0f;
    if (i % 10 == 0) records.back().flags |= InstanceRecord::kTransparent;
  }
  c.chunks = {{f.state.arena().add(records), true}};
  c.lightsChanged = true, c.lights.resize(1);
  c.lights[0].range = 1;  // casts shadows
  c.sky = {};
  std::vector<DrawList> lists(2 * views.size());
  const auto play = [&](int frames) {
    Allocations asked;
    for (int frame = 0; frame < frames; ++frame) {
      const double turn = 0.01 * static_cast<double>(f.frame % 100);
      f.viewer.set({Vec3(0.1 * turn, 0, 0), Quat(1, 0, 0, turn).normalized()},
                   {Vec3(turn, 0, 0), Quat::Identity()});
      Random now(static_cast<std::uint32_t>(f.frame % 100));
      for (InstanceId id = 0; id < 200; ++id) c.instances.push_back({id, thing(now.within(20), 0.5, 3)});
      const SlotView state = f.publish(c);
      c = {};
      const Allocations before = allocationsSoFar();
      for (std::size_t wall = 0; wall < views.size(); ++wall)
        culls[wall].fill(state, {}, lists[2 * wall + f.frame % 2]);
      asked += allocationsSoFar() - before;
    }
    return asked.count;
  };
  EXPECT_GT(play(600), 0U) << "at first it must";
  EXPECT_EQ(play(600), 0U) << "the same again and again: each frame with each slot and each list";
}

}  // namespace
}  // namespace stadion
