#include "engine/nodes/object_node.h"
#include "engine/nodes/scene_node.h"
#include "tests/engine/scene/show_fixture.h"

#include <gtest/gtest.h>

#include <array>

namespace stadion {
namespace {

/// Static objects with names, in one chunk.
void addStatics(LoadedScene& load, std::uint32_t count, const std::vector<InstanceRecord>& records,
                ChunkId chunk) {
  load.nodes.resize(count);
  load.chunk = chunk, load.staticType = &kObjectType;
  load.chunkRecords = records;
  for (std::uint32_t i = 0; i < count; ++i) {
    const auto at = load.names.emplace("stone" + std::to_string(i), i).first;
    load.statics.push_back({i, {}});
    load.staticNames.emplace_back(i, &at->first);
  }
}

TEST(ManyStatics, APromotedObjectKeepsItsNameHoweverManyThereAre) {
  constexpr std::uint32_t kAll = 100000, kSome = 10000;
  ShowFixture show;
  const MeshId mesh = show.meshes.add(unitMesh());
  std::vector<InstanceRecord> records(
      kAll, makeInstance(Affine::Identity(), *show.meshes.find(mesh), mesh, true, NodeRef{}));
  show.loader.files["show"] = [&](LoadedScene& load) { addStatics(load, kAll, records, 5); };
  show.scene.open("show");
  // Walking the table of names for each would be a thousand million steps.
  for (std::uint32_t i = 0; i < kSome; ++i) {
    const Node* node = show.scene.find({1, i * 10});
    ASSERT_TRUE(node);
    ASSERT_EQ(node->name(), "stone" + std::to_string(i * 10));
  }
  show.frame();
  EXPECT_EQ(show.changes.statics.size(), kSome);
}

TEST(ManyStatics, FilesBeyondTheNumberOfChunksAreShownObjectByObject) {
  ShowFixture show;
  const MeshId mesh = show.meshes.add(unitMesh());
  const std::vector<InstanceRecord> records(
      2, makeInstance(Affine::Identity(), *show.meshes.find(mesh), mesh, true, NodeRef{}));
  ChunkId next = 1;
  show.loader.files["part"] = [&](LoadedScene& load) { addStatics(load, 2, records, next++); };
  show.loader.files["show"] = [](LoadedScene& load) {
    for (std::size_t i = 0; i < kMostChunks + 3; ++i)
      addNode<SceneNode>(load, "part" + std::to_string(i), PlaceAttributes{}, "part", Nanoseconds{0}, true);
  };
  show.scene.open("show");
  show.frame();
  EXPECT_EQ(show.changes.chunks.size(), kMostChunks);
  EXPECT_EQ(show.changes.instances.size(), 6u) << "the objects of the last three files";
  // A chunk that goes makes room for the next one.
  show.scene.command("part0", CommandId::Unload, {}, 0);
  show.frames(2);
  show.scene.command("part0", CommandId::Load, {}, show.input.time);
  show.frames(2);
  std::size_t shown = 0;
  for (int i = 0; i < 3; ++i, show.frame())
    for (const ChangeSet::Chunk& c : show.changes.chunks) shown += c.shown;
  EXPECT_LE(shown, 1u);
  EXPECT_TRUE(show.changes.instances.empty());
}

}  // namespace
}  // namespace stadion
