#include "engine/asset/mesh_checks.h"
#include "engine/base/run_stopped.h"
#include "engine/published/shadow_places.h"
#include "pipeline/cull/shadow_cull.h"
#include "tests/pipeline/gl_draw/renderer_scene.h"

#include <gtest/gtest.h>

#include <cmath>

namespace stadion {
namespace {

using test::matt;
using test::MeshMaker;
using test::Stage;

constexpr std::uint32_t kWidth = 160, kHeight = 120;

Affine placeAt(double x, double y, double z) {
  Affine X = Affine::Identity();
  X.translation() = Vec3(x, y, z);
  return X;
}

/// Things under a sun, seen by an eye where the head is.
struct Yard {
  MeshStore meshes;
  std::vector<LightRecord> lights{1};
  ShadowPlaces places;
  std::vector<InstanceRecord> things;
  Vec3 head{0, -8, 6}, looksAt{0, 0, 0};

  Yard() {
    sun({0.6, 0, -0.8});
    lights[0].range = 1;
  }
  void sun(const Vec3& direction) {
    for (int k = 0; k < 3; ++k) lights[0].direction[k] = direction.normalized()[k];
  }
  void add(std::unique_ptr<Mesh> mesh, const Affine& X, bool moves = false) {
    finish(*mesh);  // its bounds are needed here
    const MeshId id = meshes.add(std::move(mesh));
    things.push_back(makeInstance(X, *meshes.find(id), id, true, NodeRef{}));
    if (moves) things.back().flags |= kMoves;
  }
  void addGround(double half = 50) {
    add(MeshMaker(matt(0.5f, 0.5f, 0.5f))
            .quad({-half, -half, 0}, {half, -half, 0}, {half, half, 0}, {-half, half, 0})
            .seal(),
        Affine::Identity());
  }
  void addCrate(const Affine& X, bool moves = false) {
    add(MeshMaker(matt(0.6f, 0.3f, 0.2f)).box({-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}).seal(), X, moves);
  }
  DrawList list() {
    SlotView state;
    state.lights = lights;
    const ShadowRecord rings = places.follow(head);
    state.shadows = &rings;
    state.instances = things;
    DrawList out;
    out.origin = head;
    out.viewCount = 1;
    out.views[0] = test::lookAt(Vec3::Zero(), looksAt - head, 0.9, double{kWidth} / kHeight);
    DrawLight light;
    for (std::size_t k = 0; k < 3; ++k) light.direction[k] = static_cast<float>(lights[0].direction[k]);
    light.shadows = lights[0].range > 0;
    out.lights = {light};
    StillCasters still;
    ShadowCull casters(state, still, out);
    for (const InstanceRecord& r : things) {
      casters.consider(r);
      DrawItem item;
      for (int k = 0; k < 12; ++k)
        item.model[static_cast<std::size_t>(k)] =
            static_cast<float>(r.model[k] - (k % 4 == 3 ? head[k / 4] : 0));
      item.mesh = r.mesh;
      out.opaque.push_back(item);
    }
    std::ranges::sort(out.opaque, {}, &DrawItem::mesh);
    return out;
  }
};

/// Where a point of the world is seen.
const std::uint8_t* seenAt(const test::Picture& picture, const DrawList& list, const Vec3& p_W) {
  const Vec3 p = p_W - list.origin;
  const Vec4 clip = list.views[0].projection * list.views[0].view * Vec4(p.x(), p.y(), p.z(), 1);
  const double x = (0.5 + 0.5 * clip.x() / clip.w()) * kWidth,
               y = (0.5 - 0.5 * clip.y() / clip.w()) * kHeight;
  return picture.at(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y));
}

DrawList withoutShadows(DrawList list) {
  list.shadows.light = -1;
  return list;
}

TEST(Shadows, AThingStandsInTheWayOfTheLightAndOfNothingElse) {
  Yard yard;
  yard.addGround();
  yard.addCrate(placeAt(0, 0, 2.5));
  const DrawList list = yard.list();
  Stage stage(yard.meshes, kWidth, kHeight);
  const auto lit = stage.draw(withoutShadows(list)), shaded = stage.draw(list);
  test::writePng(shaded, "shadow-of-a-crate");
  const Vec3 below(1.875, 0, 0);  // 2.5 m down along the light
  EXPECT_LT(seenAt(shaded, list, below)[0] + 60, seenAt(lit, list, below)[0]);
  EXPECT_GT(seenAt(shaded, list, below)[0], 20) << "the sky still lights it";
  for (const Vec3& beside : {Vec3(0.6, 0, 0), Vec3(3.2, 0, 0), Vec3(1.875, 1, 0), Vec3(-3, -1, 0)})
    EXPECT_EQ(seenAt(shaded, list, beside)[0], seenAt(lit, list, beside)[0]) << beside.transpose();
}

TEST(Shadows, WhatIsLitSquareOrSlantwiseDoesNotShadowItself) {
  Yard yard;
  yard.addGround(300);
  yard.add(MeshMaker(matt(0.5f, 0.5f, 0.5f)).sphere(1.5, 48).seal(), placeAt(1, 2, 1.5));
  Stage stage(yard.meshes, kWidth, kHeight);
  for (const double height : {0.15, 0.5, 1.0, 3.0}) {
    yard.sun({-0.3, 1, -height});  // from behind the eye: what it sees is lit, but for what the sphere hides
    yard.looksAt = {1, 0, 1};
    const DrawList list = yard.list();
    const auto lit = stage.draw(withoutShadows(list)), shaded = stage.draw(list);
    for (const Vec3& p : {Vec3(-3, -3, 0), Vec3(2, -4, 0), Vec3(-2.5, 1, 0), Vec3(0, -2, 0),
                          Vec3(1, 0.5, 1.5), Vec3(0.4, 0.65, 1.7)})
      EXPECT_NEAR(seenAt(shaded, list, p)[1], seenAt(lit, list, p)[1], 1) << height << ": " << p.transpose();
  }
}

TEST(Shadows, FarThingsHaveThemToo) {
  for (const double away : {15.0, 60.0, 250.0}) {
    Yard yard;
    yard.addGround(1000);
    yard.head = {0, -away, away / 2};
    Affine crate = placeAt(0, 0, away / 6);
    crate.linear() *= away / 10;
    yard.addCrate(crate);
    const DrawList list = yard.list();
    Stage stage(yard.meshes, kWidth, kHeight);
    const auto lit = stage.draw(withoutShadows(list)), shaded = stage.draw(list);
    const Vec3 below(away / 6 * 0.75, 0, 0);
    EXPECT_LT(seenAt(shaded, list, below)[0] + 60, seenAt(lit, list, below)[0]) << away;
  }
}

TEST(Shadows, WhatIsInTheMapsDoesNotDependOnWhatWasDrawnBefore) {
  Yard yard;
  yard.addGround();
  yard.addCrate(placeAt(-2, 1, 0.5));
  yard.addCrate(placeAt(0, 0, 2), true);
  const std::size_t mover = yard.things.size() - 1;
  const MeshId mesh = yard.things[mover].mesh;
  const auto go = [&](double x) {
    yard.things[mover] = makeInstance(placeAt(x, 0, 2), *yard.meshes.find(mesh), mesh, true, NodeRef{});
    yard.things[mover].flags |= kMoves;
  };
  std::vector<DrawList> lists;
  for (int step = 0; step < 12; ++step) {
    go(0.4 * step - 2);
    yard.head.x() = 0.5 * step;  // some rings follow on the way
    lists.push_back(yard.list());
  }
  std::vector<test::Picture> oneAfterTheOther;
  {
    Stage all(yard.meshes, kWidth, kHeight);
    for (const DrawList& list : lists) oneAfterTheOther.push_back(all.draw(list));
  }
  for (const std::size_t step : {3U, 7U, 11U}) {
    Stage alone(yard.meshes, kWidth, kHeight);
    EXPECT_TRUE(alone.draw(lists[step]) == oneAfterTheOther[step])
        << "a trace of an earlier frame in " << step;
  }
}

TEST(Shadows, WhatStandsStillIsDrawnAgainOnlyWhenTheHeadHasGoneFar) {
  Yard yard;
  yard.addGround();
  yard.addCrate(placeAt(0, 0, 1));
  const DrawList first = yard.list();
  yard.head += Vec3(1, 0.5, 0.3);
  const DrawList near = yard.list();
  yard.head += Vec3(2, 0, 0);
  const DrawList far = yard.list();
  for (std::size_t ring = 0; ring < kShadowRings; ++ring) {
    EXPECT_EQ(near.shadows.rings[ring].stillKey, first.shadows.rings[ring].stillKey) << ring;
    EXPECT_EQ(far.shadows.rings[ring].stillKey != first.shadows.rings[ring].stillKey, ring == 0) << ring;
  }
}

TEST(Shadows, AnotherPlaceOfACasterOrOfTheLightIsNoticed) {
  Yard yard;
  yard.addGround();
  yard.addCrate(placeAt(0, 0, 1));
  const std::uint64_t before = yard.list().shadows.rings[1].stillKey;
  yard.sun({0.61, 0, -0.8});
  EXPECT_NE(yard.list().shadows.rings[1].stillKey, before);
  yard.sun({0.6, 0, -0.8});
  EXPECT_EQ(yard.list().shadows.rings[1].stillKey, before);
  yard.things.back().model[3] += 0.001;
  EXPECT_NE(yard.list().shadows.rings[1].stillKey, before);
}

TEST(Shadows, AShowWithoutThemCarriesNothingForThem) {
  Yard yard;
  yard.addGround();
  yard.lights[0].range = 0;
  const DrawList list = yard.list();
  EXPECT_EQ(list.shadows.light, -1);
  for (const DrawShadowRing& ring : list.shadows.rings) EXPECT_TRUE(!ring.still && ring.moving.empty());
}

TEST(Shadows, GlassAndWhatIsHiddenCastNone) {
  Yard yard;
  yard.add(MeshMaker(matt(0.2f, 0.5f, 0.5f, 0.3f)).box({-1, -1, 1}, {1, 1, 2}).seal(), Affine::Identity());
  yard.addCrate(placeAt(0, 0, 1));
  yard.things.back().flags &= ~InstanceRecord::kShown;
  for (const DrawShadowRing& ring : yard.list().shadows.rings) EXPECT_TRUE(ring.still->empty());
}

TEST(Shadows, WhatMovesIsDrawnOnlyIntoTheRingsWhereItIsLookedUp) {
  const auto ringsOf = [](double away, bool moves) {
    Yard yard;
    yard.head = {0, 0, 1.7};
    yard.sun({0, 0.001, -1});
    yard.addCrate(placeAt(0, away, 1), moves);
    std::string rings;
    const DrawList list = yard.list();
    for (const DrawShadowRing& ring : list.shadows.rings)
      rings += std::to_string(ring.still->size() + ring.moving.size());
    return rings;
  };
  EXPECT_EQ(ringsOf(3, true), "1000");
  EXPECT_EQ(ringsOf(5.5, true), "1100") << "at the border both are";
  EXPECT_EQ(ringsOf(15, true), "0100");
  EXPECT_EQ(ringsOf(50, true), "0010");
  EXPECT_EQ(ringsOf(3, false), "1111");
}

TEST(Shadows, WhatMovesHasTheSameShadowAsWhatStandsStill) {
  std::array<test::Picture, 2> pictures;
  for (const bool moves : {false, true}) {
    Yard yard;
    yard.addGround();
    for (int i = 0; i < 12; ++i) yard.addCrate(placeAt(-4 + 0.7 * i, -5 + 1.1 * i, 1.5), moves);
    const DrawList list = yard.list();
    Stage stage(yard.meshes, kWidth, kHeight);
    pictures[moves] = stage.draw(list);
  }
  EXPECT_TRUE(pictures[0] == pictures[1]);
}

TEST(Shadows, BothProvidersDrawThemAlike) {
  Yard yard;
  yard.addGround();
  yard.addCrate(placeAt(0, 0, 1));
  yard.addCrate(placeAt(1, 1, 2), true);
  const DrawList list = yard.list();
  std::vector<std::vector<std::uint8_t>> pictures;
  for (const GlProviderKind kind : {GlProviderKind::OsMesa, GlProviderKind::Egl})
    pictures.push_back(Stage(yard.meshes, kWidth, kHeight, kind).draw(list).rgba);
  EXPECT_EQ(pictures[0], pictures[1]);
}

/// Gives a drawing up at every point at which it asks, and draws the same again with the same renderer.
void expectNothingLeftBehind(const MeshStore& meshes, const DrawList& list) {
  const auto whole = Stage(meshes, kWidth, kHeight).draw(list);
  Stage stage(meshes, kWidth, kHeight);
  int givenUp = 0;
  for (bool finished = false; !finished; ++givenUp) {
    int left = givenUp;
    finished = true;
    try {
      stage.renderer().draw(
          list, [&] { return left-- == 0; }, nullptr);
    } catch (const RunStopped&) {
      finished = false;
    }
    ASSERT_EQ(stage.draw(list), whole) << "given up at question " << givenUp;
  }
  EXPECT_GT(givenUp, 2);
}

TEST(Shadows, ADrawingThatWasGivenUpLeavesNothingBehind) {
  Yard yard;
  yard.addGround();
  yard.addCrate(placeAt(0, 0, 0.5));
  yard.addCrate(placeAt(2, 1, 0.5), true);
  expectNothingLeftBehind(yard.meshes, yard.list());
  MeshStore meshes;
  expectNothingLeftBehind(meshes, test::richList(meshes, double{kWidth} / kHeight));
}

}  // namespace
}  // namespace stadion
