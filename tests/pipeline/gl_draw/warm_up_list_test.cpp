#include "pipeline/gl_draw/warm_up_list.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <memory>

namespace stadion {
namespace {

std::unique_ptr<Mesh> triangle(std::uint64_t hash, float alpha) {
  auto mesh = std::make_unique<Mesh>();
  mesh->positions = {{5, 5, 5}, {7, 5, 5}, {5, 7, 5}};
  mesh->normals.assign(3, {0, 0, 1});
  mesh->indices = {0, 1, 2};
  mesh->submeshes = {{0, 3, 0}};
  mesh->materials.resize(1);
  mesh->materials[0].baseColour[3] = alpha;
  mesh->sphere = {{6, 6, 5}, 2};
  mesh->levels.resize(2);
  mesh->hash = hash;
  return mesh;
}

TEST(WarmUpList, HasOneOfEachMeshThatTheFirstFrameDoesNotShow) {
  MeshStore meshes;
  const MeshId shown = meshes.add(triangle(1, 1)), hidden = meshes.add(triangle(2, 1)),
               glass = meshes.add(triangle(3, 0.5f)), gone = meshes.add(triangle(4, 1));
  meshes.release(gone, 0);
  DrawList first;
  DrawItem item;
  item.mesh = shown;
  first.opaque = {item, item};
  const DrawList list = warmUpList(first, meshes);
  ASSERT_EQ(list.opaque.size(), 3u);
  ASSERT_EQ(list.transparent.size(), 1u);
  EXPECT_TRUE(std::ranges::is_sorted(list.opaque, {}, &DrawItem::mesh));
  EXPECT_EQ(list.transparent[0].mesh, glass);
  EXPECT_EQ(std::ranges::count(list.opaque, shown, &DrawItem::mesh), 2);
  const auto added = std::ranges::find(list.opaque, hidden, &DrawItem::mesh);
  ASSERT_NE(added, list.opaque.end());
  EXPECT_EQ(added->level, 2u) << "the coarsest one";
  // Its centre is before an eye that looks along -z.
  const auto& m = added->model;
  EXPECT_NEAR(m[0] * 6 + m[3], 0, 1e-5);
  EXPECT_NEAR(m[5] * 6 + m[7], 0, 1e-5);
  EXPECT_LT(m[10] * 5 + m[11], -1);
  EXPECT_EQ(first.opaque.size(), 2u) << "what is shown stays as it is";
}

TEST(WarmUpList, HasATransparentOneOfEachMeshThatScriptsFade) {
  MeshStore meshes;
  const MeshId shown = meshes.add(triangle(1, 1)), other = meshes.add(triangle(2, 1)), gone = other + 1;
  DrawList first;
  DrawItem item;
  item.mesh = shown;
  first.opaque = {item};
  first.paints.resize(3);
  const DrawList list = warmUpList(first, meshes, std::vector<MeshId>{shown, gone, shown});
  EXPECT_EQ(list.opaque.size(), 2u);
  ASSERT_EQ(list.transparent.size(), 1u);
  EXPECT_EQ(list.transparent[0].mesh, shown);
  ASSERT_EQ(list.transparent[0].paint, 4u);
  ASSERT_EQ(list.paints.size(), 4u);
  EXPECT_TRUE(list.paints[3].isSeeThrough());
  EXPECT_TRUE(warmUpList(first, meshes).transparent.empty());
}

}  // namespace
}  // namespace stadion
