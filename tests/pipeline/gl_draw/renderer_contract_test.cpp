// What the renderer promises besides its pixels: the same pictures everywhere, errors said once, nothing
// lost.
#include "engine/base/run_stopped.h"
#include "pipeline/surface/mesh_check.h"
#include "tests/pipeline/gl_draw/renderer_scene.h"

#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <malloc.h>
#include <map>
#include <set>
#include <thread>

namespace stadion {
namespace {

using test::matt;
using test::MeshMaker;
using test::place;
using test::Stage;

std::unique_ptr<Mesh> ball() {
  return MeshMaker(matt(0.5f, 0.4f, 0.3f)).sphere(0.5, 8).seal();
}

TEST(PictureRenderer, OsMesaAndEglGiveTheSamePixels) {
  MeshStore meshes;
  const DrawList list = test::richList(meshes, 1.5);
  const auto draw = [&](GlProviderKind kind) { return Stage(meshes, 150, 100, kind).draw(list); };
  EXPECT_EQ(draw(GlProviderKind::OsMesa), draw(GlProviderKind::Egl));
}

TEST(ThreadsRenderer, TwoThreadsWithAContextEachGiveThePicturesOfOne) {
  MeshStore meshes;
  const DrawList list = test::richList(meshes, 4.0 / 3);
  const auto draw = [&](std::uint32_t eye) { return Stage(meshes, 96, 72).draw(list, eye); };
  const test::Picture left = draw(0), right = draw(1);
  std::array<std::vector<test::Picture>, 2> found;
  {
    std::array<std::jthread, 2> threads;
    for (std::uint32_t eye = 0; eye < 2; ++eye)
      threads[eye] = std::jthread([&, eye] {
        for (int i = 0; i < 3; ++i) found[eye].push_back(draw(eye));
      });
  }
  for (const auto& picture : found[0]) EXPECT_EQ(picture, left);
  for (const auto& picture : found[1]) EXPECT_EQ(picture, right);
}

/// Some threads read their picture while others draw theirs: there Mesa looks, unguarded, at what other
/// contexts are just giving up. Memory given back is overwritten, so that a look at it does not pass by luck.
TEST(ThreadsRenderer, ManyContextsDrawAndReadAllTheTime) {
  constexpr std::size_t kWalls = 6, kPictures = 20, kMeshes = 100;
  mallopt(M_PERTURB, 0xa5);
  MeshStore meshes;
  DrawList list = test::plainList();
  for (std::size_t i = 0; i < kMeshes; ++i) {
    auto textured = MeshMaker(matt(0.5f, 0.4f, 0.01f * static_cast<float>(i)));
    list.opaque.push_back(place(meshes.add(textured.texture(test::chequered(8, 2)).sphere(0.5, 8).seal())));
  }
  const test::Picture expected = Stage(meshes, 16, 16).draw(list);
  std::array<std::size_t, kWalls> wrong{};
  {
    std::array<std::jthread, kWalls> threads;
    for (std::size_t wall = 0; wall < kWalls; ++wall)
      threads[wall] = std::jthread([&, wall] {
        Stage stage(meshes, 16, 16);
        for (std::size_t i = 0; i < kPictures; ++i) wrong[wall] += stage.draw(list) != expected;
      });
  }
  mallopt(M_PERTURB, 0);
  EXPECT_EQ(wrong, (std::array<std::size_t, kWalls>{}));
}

TEST(PictureRenderer, OneCallDrawsBothEyes) {
  MeshStore meshes;
  const DrawList list = test::richList(meshes, 1);
  const auto draw = [&](std::uint32_t eye) { return Stage(meshes, 50, 50).draw(list, eye); };
  const auto left = draw(0), right = draw(1);
  Stage both(meshes, 50, 50);
  ASSERT_FALSE(both.renderer().draw(list));
  test::Picture picture = left;
  ASSERT_FALSE(both.renderer().read(0, picture.rgba));
  EXPECT_EQ(picture, left);
  ASSERT_FALSE(both.renderer().read(1, picture.rgba));
  EXPECT_EQ(picture, right);
}

TEST(PictureRenderer, AWallNeedsOnlyTheInterface) {
  MeshStore meshes;
  const DrawList list = test::richList(meshes, 1);
  const auto expected = Stage(meshes, 50, 50).draw(list);
  Stage stage(meshes, 50, 50);
  Renderer& renderer = stage.renderer();
  ASSERT_FALSE(renderer.warmUp(list, {}));
  EXPECT_EQ(renderer.totals()[0].frames, 0U) << "a warm-up is not counted";
  ASSERT_FALSE(renderer.draw(list, {}, nullptr));
  test::Picture picture = expected;
  ASSERT_FALSE(renderer.read(0, picture.rgba));
  EXPECT_EQ(picture, expected);
  EXPECT_EQ(renderer.totals()[0].frames, 1U);
  EXPECT_GT(renderer.totals()[1].triangles, 0U);
  EXPECT_FALSE(renderer.isLost());
  EXPECT_FALSE(renderer.description().empty());
}

TEST(PictureRenderer, EndsADrawingThatItsCallerGivesUp) {
  MeshStore meshes;
  const DrawList list = test::richList(meshes, 1);
  const auto expected = Stage(meshes, 50, 50).draw(list);
  Stage stage(meshes, 50, 50);
  int asked = 0;
  const std::function<bool()> giveUp = [&] { return ++asked == 3; };
  EXPECT_THROW(stage.renderer().draw(list, giveUp, nullptr), RunStopped);
  EXPECT_EQ(stage.draw(list), expected) << "the next picture shows nothing of it";
}

TEST(PictureRenderer, InstancesLookLikeSingleMeshes) {
  MeshStore meshes;
  DrawList list = test::plainList();
  const MeshId same = meshes.add(ball()), other = meshes.add(ball());
  for (int i = 0; i < 9; ++i) {
    Affine X = Affine::Identity();
    X.translation() = Vec3(0.6 * (i % 3 - 1), 0.1 * i, 0.6 * (i / 3 - 1));
    X.linear() *= i % 2 ? -1 : 1;
    list.opaque.push_back(place(same, X));
  }
  Stage stage(meshes, 64, 64);
  const auto together = stage.draw(list);
  EXPECT_EQ(stage.renderer().counts().calls, 3u);  // as it is, mirrored, sky
  for (std::size_t i = 0; i < list.opaque.size(); i += 2) list.opaque[i].mesh = other;
  EXPECT_EQ(stage.draw(list), together);
  EXPECT_EQ(stage.renderer().counts().calls, 10u);
}

/// Wants pieces of every frame drawn alone, one eye's after the other as far as they go.
struct Sampling final : FrameProbe {
  std::vector<IsolatedDrawTime> pieces;
  std::map<NodeRef, int> told;
  std::set<NodeRef> alone;  ///< drawn with no other node
  double parts = 0;         ///< of all pieces
  std::size_t asked = 0, next = 0;
  std::set<NodeRef> wanted;  ///< empty: all

  void began(Span, std::uint64_t, std::uint32_t) override {}
  void began(Span, NodeRef) override {}
  void ended(Span) override {}
  DrawSample drawSample(std::uint64_t, std::uint32_t) override { return DrawSample::Some; }
  bool wantsAlone(std::span<const NodeRef> owners) const override {
    return wanted.empty() || std::ranges::any_of(owners, [&](NodeRef n) { return wanted.contains(n); });
  }
  std::size_t nextBatch(std::uint32_t, std::uint32_t, std::size_t batches) override {
    asked = batches;
    const std::size_t now = next;
    next = now + kBatchesAFrame < batches ? now + kBatchesAFrame : 0;
    return now;
  }
  void drewAlone(const IsolatedDrawTime& drawn, std::span<const NodeShare> nodes) override {
    if (drawn.what != Span::Draw) return;
    pieces.push_back(drawn);
    for (const NodeShare& share : nodes) ++told[share.node], parts += double{share.part};
    if (nodes.size() == 1) alone.insert(nodes[0].node);
  }
};

/// Lamps of an opaque foot and a shade of glass, side by side.
DrawList lamps(MeshStore& meshes, std::uint32_t count) {
  auto lamp = MeshMaker(matt(0.5f, 0.4f, 0.3f))
                  .box(Vec3(-0.1, -0.1, -0.5), Vec3(0.1, 0.1, 0.5))
                  .box(Vec3(-0.2, -0.2, 0), Vec3(0.2, 0.2, 0.4))
                  .seal();
  const auto half = static_cast<std::uint32_t>(lamp->indices.size() / 2);
  lamp->materials.push_back(matt(0.2f, 0.8f, 0.3f, 0.5f));
  lamp->submeshes = {{0, half, 0}, {half, half, 1}};
  const MeshId id = meshes.add(std::move(lamp));
  DrawList list = test::plainList();
  for (std::uint32_t i = 0; i < count; ++i) {
    Affine X = Affine::Identity();
    X.translation() = Vec3(1.6 * (i + 0.5) / count - 0.8, 0, 0);
    list.transparent.push_back(place(id, X));
    list.transparent.back().owner = {1, i};
    list.transparent.back().pixels = 20;
  }
  return list;
}

TEST(PictureRenderer, WhatIsDrawnInTwoPassesIsOnePieceThatHasItsTurn) {
  constexpr std::uint32_t kLamps = 100;
  MeshStore meshes;
  const DrawList list = lamps(meshes, kLamps);
  Stage stage(meshes, 96, 72);
  const test::Picture plain = stage.draw(list);
  Sampling probe;
  constexpr int kRounds = 3;
  for (int round = 0; round < kRounds; ++round) do {
      ASSERT_FALSE(stage.renderer().draw(list, std::function<bool()>{}, &probe));
    } while (probe.next != 0);
  EXPECT_EQ(probe.pieces.size(), kRounds * probe.asked) << "each piece is told once a round";
  ASSERT_EQ(probe.told.size(), kLamps) << "everybody has a turn";
  for (const auto& [node, times] : probe.told) EXPECT_EQ(times, kRounds) << node.position;
  test::Picture sampled = plain;
  ASSERT_FALSE(stage.renderer().read(0, sampled.rgba));
  EXPECT_EQ(sampled, plain);
}

TEST(PictureRenderer, WhatIsNotWantedAloneTakesNoTurn) {
  constexpr std::uint32_t kLamps = 100;
  MeshStore meshes;
  const DrawList list = lamps(meshes, kLamps);
  Stage stage(meshes, 96, 72);
  stage.draw(list);
  Sampling all, some;
  ASSERT_FALSE(stage.renderer().draw(list, std::function<bool()>{}, &all));
  some.wanted = {{1, 3}, {1, 90}};
  ASSERT_FALSE(stage.renderer().draw(list, std::function<bool()>{}, &some));
  EXPECT_GT(all.asked, kBatchesAFrame);
  EXPECT_EQ(some.asked, 2U);
  EXPECT_EQ(some.pieces.size(), 2U) << "not what lies between them";
  EXPECT_TRUE(some.told.contains({1, 3}) && some.told.contains({1, 90}));
}

TEST(PictureRenderer, SmallObjectRasterizerOfManyMeshesAreDrawnAloneTogether) {
  constexpr std::uint32_t kThings = 400;
  MeshStore meshes;
  DrawList list = test::plainList();
  for (std::uint32_t i = 0; i < kThings; ++i) {
    Affine X = Affine::Identity();
    X.translation() = Vec3(1.6 * (i % 20) / 20.0 - 0.8, 0, 1.6 * (i / 20) / 20.0 - 0.8);
    X.linear() *= i == 0 ? 0.2 : 0.05;
    list.opaque.push_back(place(meshes.add(ball()), X));
    list.opaque.back().owner = {1, i};
    list.opaque.back().pixels = i == 0 ? 1e6f : 10;
  }
  Stage stage(meshes, 96, 72);
  const test::Picture plain = stage.draw(list);
  Sampling probe;
  do ASSERT_FALSE(stage.renderer().draw(list, std::function<bool()>{}, &probe));
  while (probe.next != 0);
  EXPECT_LE(probe.asked, 1 + 2 * static_cast<std::size_t>(DrawSampler::kMostJoined));
  EXPECT_EQ(probe.told.size(), kThings) << "everybody has a turn";
  for (const auto& [node, times] : probe.told) EXPECT_EQ(times, 1) << node.position;
  EXPECT_NEAR(probe.parts, static_cast<double>(probe.pieces.size()), 1e-3) << "the parts of each sum to 1";
  EXPECT_EQ(probe.alone, (std::set<NodeRef>{{1, 0}})) << "what is large is a piece by itself";
  test::Picture sampled = plain;
  ASSERT_FALSE(stage.renderer().read(0, sampled.rgba));
  EXPECT_EQ(sampled, plain);
}

TEST(PictureRenderer, ServesOddSizes) {
  MeshStore meshes;
  const DrawList list = test::richList(meshes, 1);
  for (const auto& [width, height] : {std::pair{1u, 1u}, {3u, 97u}, {641u, 2u}, {16384u, 1u}})
    EXPECT_EQ(Stage(meshes, width, height).draw(list).rgba.size(), width * height * 4u);
}

TEST(PictureRenderer, OneSampleAPixelGivesHardEdges) {
  MeshStore meshes;
  DrawList list = test::plainList();
  list.sky.horizon = list.sky.zenith = list.sky.ground = {0, 0, 0};
  Material white = matt(0, 0, 0);
  white.emissive = {1, 1, 1};
  list.opaque = {place(meshes.add(MeshMaker(white).triangle({-1, 0, -1}, {1, 0, -1}, {-0.9, 0, 1}).seal()))};
  Stage stage(meshes, 32, 32);
  const auto shades = [&](std::uint32_t samples) {
    auto renderer = GlRenderer::create(stage.gl(), stage.turns(), meshes, 32, 32, {Look::Full, samples});
    EXPECT_TRUE(renderer);
    EXPECT_FALSE(renderer.value()->draw(list));
    std::vector<std::uint8_t> rgba(32 * 32 * 4);
    EXPECT_FALSE(renderer.value()->read(0, rgba));
    std::set<std::uint8_t> found;
    for (std::size_t i = 0; i < rgba.size(); i += 4) found.insert(rgba[i]);
    return found.size();
  };
  EXPECT_EQ(shades(1), 2u);
  EXPECT_EQ(shades(4), 5u);
  EXPECT_GE(shades(1000), 2u);  // as many as there are
}

TEST(PictureRenderer, RefusesSizesThatNoBufferHas) {
  MeshStore meshes;
  Stage stage(meshes, 4, 4);
  EXPECT_FALSE(GlRenderer::create(stage.gl(), stage.turns(), meshes, 0, 4));
  EXPECT_FALSE(GlRenderer::create(stage.gl(), stage.turns(), meshes, 16385, 4));
}

TEST(PictureRenderer, FreesMeshesThatTheStoreHasFreed) {
  MeshStore meshes;
  Stage stage(meshes, 16, 16);
  DrawList list = test::plainList();
  const MeshId kept = meshes.add(ball());
  for (std::uint64_t frame = 0; frame < 20; ++frame) {
    const MeshId passing = meshes.add(ball());
    list.opaque = {place(kept), place(passing)};
    stage.draw(list);
    EXPECT_EQ(stage.renderer().meshesHeld(), 2u);
    meshes.release(passing, frame);
    meshes.collect(frame);
  }
}

TEST(PictureRenderer, SaysOnceThatAMeshIsGoneAndDrawsTheRest) {
  MeshStore meshes;
  Stage stage(meshes, 16, 16);
  DrawList list = test::plainList();
  list.opaque = {place(77), place(meshes.add(ball()))};
  const auto problem = stage.renderer().draw(list);
  ASSERT_TRUE(problem);
  EXPECT_EQ(problem->message, "mesh 77 is to be drawn but no longer there");
  EXPECT_FALSE(stage.renderer().draw(list));
  EXPECT_EQ(stage.renderer().counts().instances, 1u);
}

TEST(PictureRenderer, LeavesOutWhatIsNotFinite) {
  MeshStore meshes;
  Stage stage(meshes, 16, 16);
  DrawList list = test::plainList();
  const DrawItem sound = place(meshes.add(ball()));
  list.opaque = {sound};
  const auto expected = stage.draw(list);
  DrawItem broken = sound;
  broken.model[5] = std::numeric_limits<float>::quiet_NaN();
  list.opaque = {broken, sound};
  list.transparent = {broken};
  EXPECT_TRUE(stage.renderer().draw(list));
  EXPECT_EQ(stage.draw(list), expected);
  list.views[0].view(1, 1) = std::numeric_limits<double>::infinity();
  EXPECT_TRUE(stage.renderer().draw(list, 0));
  EXPECT_FALSE(stage.renderer().draw(list, 0));
}

TEST(PictureRenderer, DrawsAnEmptyListAndTooManyLights) {
  MeshStore meshes;
  Stage stage(meshes, 16, 16);
  DrawList list = test::plainList();
  EXPECT_FALSE(stage.renderer().draw(list));
  list.lights.resize(DrawList::kMaxLights + 1);
  EXPECT_TRUE(stage.renderer().draw(list));
}

TEST(PictureRenderer, RefusesAMeshThatWouldReadBeyondItsVertices) {
  MeshStore meshes;
  Stage stage(meshes, 16, 16);
  auto mesh = ball();
  mesh->indices[5] = 1u << 30;
  DrawList list = test::plainList();
  list.opaque = {place(meshes.add(std::move(mesh)))};
  const auto problem = stage.renderer().draw(list);
  ASSERT_TRUE(problem);
  EXPECT_NE(problem->message.find("a vertex that is not there"), std::string::npos);
}

TEST(RendererSurface, ClosedMeshesEncloseAndOpenOnesDoNot) {
  EXPECT_TRUE(isClosed(*ball()));
  EXPECT_TRUE(isClosed(*MeshMaker(matt(1, 1, 1)).box({0, 0, 0}, {1, 2, 3}).seal()));
  EXPECT_FALSE(isClosed(*MeshMaker(matt(1, 1, 1)).quad({0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}).seal()));
  auto holed = MeshMaker(matt(1, 1, 1)).box({0, 0, 0}, {1, 2, 3}).seal();
  holed->indices.resize(holed->indices.size() - 3);
  EXPECT_FALSE(isClosed(*holed));
}

TEST(RendererSurface, EveryKindOfDamageIsNamed) {
  const auto damaged = [](auto damage) {
    auto mesh = ball();
    damage(*mesh);
    return drawingFault(*mesh);
  };
  EXPECT_EQ(drawingFault(*ball()), "");
  EXPECT_NE(damaged([](Mesh& m) { m.normals.pop_back(); }), "");
  EXPECT_NE(damaged([](Mesh& m) { m.uvs.pop_back(); }), "");
  EXPECT_NE(damaged([](Mesh& m) { m.colours.resize(1); }), "");
  EXPECT_NE(damaged([](Mesh& m) { m.submeshes[0].firstIndex = 3; }), "");
  EXPECT_NE(damaged([](Mesh& m) { m.submeshes[0].material = 1; }), "");
  EXPECT_NE(damaged([](Mesh& m) { m.materials[0].maps[kBaseMap].texture = 0; }), "");
  EXPECT_NE(damaged([](Mesh& m) { m.textures.push_back({9000, 1, {}, "long"}); }), "");
}

}  // namespace
}  // namespace stadion
