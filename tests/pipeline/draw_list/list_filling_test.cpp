/// Draw begins while Cull still fills its list: the same pictures, nothing torn, no thread left waiting.

#include "pipeline/draw_list/list_filling.h"

#include "pipeline/loop/frame_loop.h"
#include "tests/pipeline/cull/cull_room.h"
#include "tests/pipeline/gl_draw/renderer_scene.h"

#include <gtest/gtest.h>
#include <thread>

namespace stadion {
namespace {

using test::Random;

/// Some thousand things of each kind, mirrored ones and some to see through among them.
DrawList crowdedList(MeshStore& meshes, Random& random, bool lamps) {
  DrawList list = test::richList(meshes, 1.5);
  if (!lamps)
    std::erase_if(list.lights, [](const DrawLight& l) { return l.kind != DrawLight::Kind::Directional; });
  list.shadows.light = -1, list.sky.hazeDistance = 0;
  test::MeshMaker pictured(test::matt(1, 1, 1));
  pictured.texture(test::chequered(16, 4)).quad({-1, 0, -1}, {1, 0, -1}, {1, 0, 1}, {-1, 0, 1});
  const MeshId ids[] = {
      meshes.add(test::MeshMaker(test::matt(0.9f, 0.2f, 0.1f)).sphere(1, 8).seal()),
      meshes.add(test::MeshMaker(test::matt(0.1f, 0.8f, 0.1f)).box(Vec3(-1, -1, -1), Vec3(1, 1, 1)).seal()),
      meshes.add(pictured.seal())};
  for (int i = 0; i < 4500; ++i) {
    Affine X = Affine::Identity();
    X.translation() = Vec3(0, random.sizeFrom(6, 60), 0) + 0.2 * random.within(60);
    X.linear() = random.turned().toRotationMatrix() * random.sizeFrom(0.05, 0.5);
    if (i % 5 == 0) X.linear().col(0) *= -1;
    list.opaque.push_back(test::place(ids[i % 8 == 0 ? 2 : i % 2], X));
    list.opaque.back().distance = static_cast<float>(X.translation().norm());
  }
  std::ranges::stable_sort(list.opaque, {}, &DrawItem::mesh);
  list.views[0] = test::lookAt(Vec3(-0.03, 0, 0), Vec3(0, 1, 0), 1.3, 1.5);
  list.views[1] = test::lookAt(Vec3(0.03, 0, 0), Vec3(0, 1, 0), 1.3, 1.5);
  list.viewCount = 2;
  return list;
}

using Pictures = std::array<std::vector<std::uint8_t>, 2>;

Pictures picturesOf(GlRenderer& renderer) {
  Pictures pictures;
  for (std::uint32_t eye = 0; eye < 2; ++eye) {
    pictures[eye].resize(std::size_t{renderer.width()} * renderer.height() * 4);
    EXPECT_FALSE(renderer.read(eye, pictures[eye]));
  }
  return pictures;
}

TEST(ThreadsListFilling, PicturesAreThoseOfTheWholeList) {
  Random random(71);
  RenderQuality byOpenGl = RenderQuality::plain();
  byOpenGl.drawsSmallObjects = false;
  RenderQuality asOnCard;
  asOnCard.submission = {GlUse::Always, GlUse::Always};
  for (const RenderQuality quality : {RenderQuality::plain(), byOpenGl, RenderQuality{}, asOnCard})
    for (const bool lamps : {false, true}) {
      MeshStore meshes;
      const DrawList whole = crowdedList(meshes, random, lamps);
      auto target = test::provider(GlProviderKind::OsMesa)->create(150, 100);
      ASSERT_TRUE(target && !target.value()->makeCurrent());
      auto renderer =
          GlRenderer::create(target.value()->gl(), target.value()->turns(), meshes, 150, 100, quality);
      ASSERT_TRUE(renderer);
      std::optional<Pictures> expected;
      for (int round = 0; round < 4; ++round) {
        DrawList growing = whole;
        growing.opaque.assign(whole.opaque.size(), {}),
            growing.transparent.assign(whole.transparent.size(), {});
        bool handed = false;
        ListFilling filling([&] { handed = true; }, true);
        growing.filling = &filling;
        filling.begin();
        EXPECT_TRUE(handed);
        std::jthread cull([&] {
          for (std::size_t from = 0; from < whole.opaque.size(); from += 500) {
            const std::size_t end = std::min(from + 500, whole.opaque.size());
            std::copy(whole.opaque.begin() + static_cast<std::ptrdiff_t>(from),
                      whole.opaque.begin() + static_cast<std::ptrdiff_t>(end),
                      growing.opaque.begin() + static_cast<std::ptrdiff_t>(from));
            filling.reach(end);
            std::this_thread::sleep_for(std::chrono::microseconds(random.below(800)));
          }
          std::ranges::copy(whole.transparent, growing.transparent.begin());
          filling.finish();
        });
        // The first round is the first time that meshes are drawn.
        const auto wrong = renderer.value()->draw(growing);
        ASSERT_FALSE(wrong) << wrong->message;
        const Pictures seen = picturesOf(*renderer.value());
        if (!expected) {
          ASSERT_FALSE(renderer.value()->draw(whole));
          expected = picturesOf(*renderer.value());
          EXPECT_NE((*expected)[0], (*expected)[1]);
        }
        EXPECT_TRUE(seen == *expected) << "lamps " << lamps << ", round " << round;
      }
      renderer.value().reset();
    }
}

TEST(ListFilling, BatchesDoNotDependOnHowItemsCome) {
  Random random(72);
  MeshStore meshes;
  const DrawList list = crowdedList(meshes, random, false);
  InstanceBatches whole, growing;
  whole.build(list.opaque, list.transparent);
  growing.begin();
  for (std::size_t there = 0; there < list.opaque.size(); there += 1 + random.below(700))
    growing.addOpaque(list.opaque, there);
  EXPECT_LT(growing.taken(), list.opaque.size()) << "the last portion is not complete";
  growing.addOpaque(list.opaque, list.opaque.size());
  growing.addTransparent(list.transparent);
  ASSERT_EQ(growing.opaque().size(), whole.opaque().size());
  for (std::size_t i = 0; i < whole.opaque().size(); ++i) {
    const InstanceBatch &a = growing.opaque()[i], &b = whole.opaque()[i];
    EXPECT_EQ(std::tie(a.mesh, a.first, a.count, a.mirrored), std::tie(b.mesh, b.first, b.count, b.mirrored));
    EXPECT_LE(a.count, DrawList::kPortion);
  }
  EXPECT_TRUE(std::ranges::equal(growing.matrices(), whole.matrices()));
  EXPECT_EQ(growing.refused(), whole.refused());
}

/// Stages whose Cull waits, in the middle of a list, for what its Draw does.
struct MeetingStages : Stages {
  std::atomic<int> drawing = 0, drawn = 0;
  bool early = false;  ///< Draw is to begin meanwhile, but in the first frame: the warm-up needs a whole list
  std::uint64_t throwsAt = ~std::uint64_t{0};
  int shown = 0;

  void app(const TimeSignature&, std::size_t) override {}
  void cull(std::size_t, std::size_t, DrawList& list) override {
    const int before = drawing;
    list.opaque.resize(2);
    list.filling->begin();
    list.filling->reach(1);
    const bool meets = early && list.ticket.signature.frame > 0;
    if (meets) {
      while (drawing == before) std::this_thread::yield();
    } else {
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    if (list.ticket.signature.frame == throwsAt) throw std::bad_alloc();
    list.opaque[1].mesh = 7;
  }
  Failure openWall(std::size_t) override { return {}; }
  Failure draw(std::size_t, const DrawList& list) override {
    const bool meets = early && list.ticket.signature.frame > 0;
    EXPECT_EQ(list.filling->await(0), meets ? 1U : ListFilling::kAll);
    ++drawing;
    const bool whole = list.filling->isWhole();
    EXPECT_TRUE(!whole || list.opaque[1].mesh == 7);
    ++drawn;
    return {};
  }
  void closeWall(std::size_t) override {}
  Failure swap(const TimeSignature&) override { return ++shown, kNoFailure; }
};

FrameLoopOutcome play(MeetingStages& stages, bool early) {
  stages.early = early;
  FrameLoopOptions o;
  o.frames = 20, o.drawBeginsEarly = early;
  // Else Draw of one frame might be what Cull of the next one waits for.
  o.mostInFlight = 1;
  const std::atomic<bool> stop = false;
  FrameLoop loop(stages, o, stop);
  return loop.run();
}

TEST(ThreadsListFilling, DrawBeginsBeforeCullEnds) {
  MeetingStages stages;
  const FrameLoopOutcome outcome = play(stages, true);
  EXPECT_FALSE(outcome.failure);
  EXPECT_EQ(stages.shown, 20);
  EXPECT_EQ(stages.drawn, 20);
}

TEST(ThreadsListFilling, OrAfterItWhereThatIsWanted) {
  MeetingStages stages;
  EXPECT_FALSE(play(stages, false).failure);
  EXPECT_EQ(stages.shown, 20);
}

TEST(ThreadsListFilling, ACullThatFailsInTheMiddleEndsTheRun) {
  MeetingStages stages;
  stages.throwsAt = 7;
  const FrameLoopOutcome outcome = play(stages, true);
  ASSERT_TRUE(outcome.failure);
  EXPECT_NE(outcome.failure->message.find("Cull of wall 1, frame 7: out of memory"), std::string::npos)
      << outcome.failure->message;
  EXPECT_EQ(stages.shown, 7);
}

TEST(ListFilling, WhatIsVoidIsNotWhole) {
  int handed = 0;
  ListFilling filling([&] { ++handed; }, true);
  filling.begin();
  filling.reach(3);
  EXPECT_EQ(filling.await(2), 3U);
  filling.finish(true);
  EXPECT_EQ(filling.await(3), ListFilling::kAll);
  EXPECT_FALSE(filling.isWhole());
  filling.restart();
  EXPECT_FALSE(filling.isVoid());
  filling.finish();
  EXPECT_TRUE(filling.isWhole());
  EXPECT_EQ(handed, 2) << "once for each list";
}

}  // namespace
}  // namespace stadion
