/// A painted object is drawn as a mesh whose materials have the paint's colours.

#include "pipeline/cpu_draw/kernels/choose_kernels.h"
#include "pipeline/cpu_draw/mesh/mesh_paints.h"
#include "pipeline/surface/painted_material.h"
#include "tests/pipeline/cpu_draw/compared_pictures.h"

#include <gtest/gtest.h>

#include <array>
#include <string>
#include <thread>

namespace stadion::test {
namespace {

constexpr std::uint32_t kPaintSide = 128;

const PaintRecord kReddened{{1, 0.2f, 0.1f}, 1, {0, 0, 0}}, kGlowing{{1, 1, 1}, 1, {0.1f, 0.3f, 0}},
    kFaint{{0.3f, 1, 0.3f}, 0.4f, {0.05f, 0, 0}}, kAlmostGone{{1, 1, 1}, 0.01f, {0, 0, 0}};

Affine standingAt(double x, double y, double z) {
  Affine X = Affine::Identity();
  X.translation() = Vec3(x, y, z);
  return X;
}

/// A chequered box, a leaf with holes and a pane of glass.
std::unique_ptr<Mesh> crate() {
  MeshMaker maker(matt(0.7f, 0.6f, 0.5f));
  maker.texture(chequered(32, 4));
  auto mesh = maker.box({-0.4, -0.4, 0}, {0.4, 0.4, 0.8})
                  .quad({-0.5, -0.6, 0.1}, {0.5, -0.6, 0.1}, {0.5, -0.6, 0.5}, {-0.5, -0.6, 0.5})
                  .quad({-0.5, -0.7, 0.4}, {0.5, -0.7, 0.4}, {0.5, -0.7, 0.9}, {-0.5, -0.7, 0.9})
                  .seal();
  Material leaf = mesh->materials[0], glass = matt(0.2f, 0.5f, 0.9f, 0.5f);
  for (std::size_t i = 3; i < mesh->textures[0].rgba.size(); i += 4 * 5) mesh->textures[0].rgba[i] = 0;
  leaf.alphaCutoff = 0.5f;
  leaf.doubleSided = glass.doubleSided = true;
  leaf.emissive = {0, 0, 0.2f};
  mesh->materials.insert(mesh->materials.end(), {leaf, glass});
  const auto all = static_cast<std::uint32_t>(mesh->indices.size());
  mesh->submeshes = {{0, all - 12, 0}, {all - 12, 6, 1}, {all - 6, 6, 2}};
  return mesh;
}

/// A crate in a paint before a wall, and the same with a mesh that has these materials.
struct PaintScene {
  explicit PaintScene(const PaintRecord& paint, bool levels = false) {
    auto mesh = crate();
    if (levels) mesh->levels.push_back({mesh->indices, mesh->submeshes, 0.1});
    auto baked = std::make_unique<Mesh>(*mesh);
    for (Material& m : baked->materials) m = painted(m, paint);
    baked->materials.push_back(mesh->materials[1]);  // smaller levels of its picture are those of holes
    baked->hash ^= 4711;
    bare = meshes.add(std::move(mesh));
    const MeshId asPainted = meshes.add(std::move(baked));
    const MeshId wall = meshes.add(
        MeshMaker(matt(0.5f, 0.7f, 0.4f)).quad({-2, 1, 0}, {2, 1, 0}, {2, 1, 2}, {-2, 1, 2}).seal());
    withPaint = withMesh = plainList();
    for (DrawList* list : {&withPaint, &withMesh}) {
      list->views[0] = lookAt(Vec3(1.2, -2.2, 1.2), Vec3(0, 0, 0.4), 0.9, 1);
      DrawLight sun;
      sun.direction = {-0.3f, 0.6f, -0.74f};
      list->lights.push_back(sun);
      list->opaque.push_back(place(wall));
    }
    withMesh.transparent.push_back(place(asPainted));
    withPaint.transparent.push_back(place(bare));
    withPaint.transparent.back().paint = 2;
    withPaint.paints = {kReddened, paint};
    if (levels) withPaint.transparent.back().level = withMesh.transparent.back().level = 1;
  }
  MeshStore meshes;
  MeshId bare = kNoMesh;
  DrawList withPaint, withMesh;
};

/// A wall that fills the picture, before a black one, seen in the middle.
std::array<Picture, 2> fullWall(const Material& material, const PaintRecord& paint) {
  MeshStore meshes;
  Material dark = matt(0, 0, 0);
  dark.unlit = true;
  const auto wall = [&](const Material& m, double y) {
    return meshes.add(MeshMaker(m).quad({-1, y, -1}, {1, y, -1}, {1, y, 1}, {-1, y, 1}).seal());
  };
  const MeshId behind = wall(dark, 0.2), before = wall(material, 0);
  DrawList list = plainList();
  list.views[0] = orthographic();
  list.opaque.push_back(place(behind));
  (paint.isSeeThrough() ? list.transparent : list.opaque).push_back(place(before));
  (paint.isSeeThrough() ? list.transparent : list.opaque).back().paint = 1;
  list.paints = {paint};
  return {drawnByCpu(meshes, list, 8, 8), drawnByOpenGl(meshes, list, 8, 8)};
}

TEST(PaintDrawing, TintMultipliesEmissionAddsAndOpacityBlends) {
  Material half = matt(0.5f, 0.5f, 0.5f), black = matt(0, 0, 0);
  half.unlit = true;
  black.roughness = 1;
  for (const Picture& p : fullWall(half, {{1, 0.4f, 0}, 1, {0, 0, 0}}))
    for (std::size_t k = 0; k < 3; ++k)
      EXPECT_NEAR(p.at(4, 4)[k], sRgb(std::array{0.5, 0.2, 0.0}[k]), 1) << k;
  for (const Picture& p : fullWall(half, {{1, 1, 1}, 0.4f, {0, 0, 0}}))
    EXPECT_NEAR(p.at(4, 4)[1], sRgb(0.2), 1);
  const auto unpainted = fullWall(black, {}), glowing = fullWall(black, {{1, 1, 1}, 1, {0, 0.5f, 0}});
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(glowing[i].at(4, 4)[0], unpainted[i].at(4, 4)[0]);
    EXPECT_NEAR(glowing[i].at(4, 4)[1], sRgb(0.5), 14) << "and what a matt surface reflects";
  }
}

TEST(PaintDrawing, APaintedMeshIsDrawnAsOneWithTheseMaterials) {
  for (const PaintRecord& paint : {kReddened, kGlowing, kFaint, kAlmostGone})
    for (const Look look : {Look::Full, Look::Plain}) {
      PictureRung rung;
      rung.look = look;
      const PaintScene scene(paint, look == Look::Plain);
      const Picture cpu = drawnByCpu(scene.meshes, scene.withPaint, kPaintSide, kPaintSide, rung);
      EXPECT_EQ(cpu, drawnByCpu(scene.meshes, scene.withMesh, kPaintSide, kPaintSide, rung));
      DrawList bare = scene.withPaint;
      bare.transparent.back().paint = 0;
      EXPECT_NE(cpu, drawnByCpu(scene.meshes, bare, kPaintSide, kPaintSide, rung));
      RenderQuality quality;
      quality.look = look;
      for (const GlUse indirect : {GlUse::Never, GlUse::Always}) {
        quality.submission.indirect = indirect;
        EXPECT_EQ(drawnByOpenGl(scene.meshes, scene.withPaint, kPaintSide, kPaintSide, quality),
                  drawnByOpenGl(scene.meshes, scene.withMesh, kPaintSide, kPaintSide, quality));
      }
    }
}

TEST(PaintDrawing, BothRenderersDrawPaintAlike) {
  for (const PaintRecord& paint : {kReddened, kGlowing, kFaint, kAlmostGone}) {
    const PaintScene scene(paint);
    const PictureDifference d =
        difference(drawnByCpu(scene.meshes, scene.withPaint, kPaintSide, kPaintSide),
                   drawnByOpenGl(scene.meshes, scene.withPaint, kPaintSide, kPaintSide));
    EXPECT_LE(d.mean, 0.3) << paint.opacity;
    EXPECT_GE(d.alike, 0.995) << paint.opacity;
  }
}

TEST(PaintDrawing, KernelsAndThreadsDoNotChangeThePicture) {
  for (const PaintRecord& paint : {kReddened, kFaint}) {
    const PaintScene scene(paint);
    const Picture one = drawnByCpu(scene.meshes, scene.withPaint, kPaintSide, kPaintSide);
    for (const DrawKernels* kernels : drawKernelsHere())
      for (const std::size_t threads : {1u, 3u})
        EXPECT_EQ(one,
                  drawnByCpu(scene.meshes, scene.withPaint, kPaintSide, kPaintSide, {}, threads, kernels))
            << kernels->name << " " << threads;
  }
}

/// One context draws list after list. A number gets another paint, and an opaque object becomes transparent and
/// opaque again.
TEST(PaintDrawing, OpenGlFollowsAPaintFromFrameToFrame) {
  const std::array paints{kReddened, kFaint, kGlowing};
  std::vector<Picture> expected;  // a context of their own, which goes before the next one is made
  for (const PaintRecord& paint : paints) {
    const PaintScene same(paint);
    expected.push_back(drawnByOpenGl(same.meshes, same.withMesh, kPaintSide, kPaintSide));
  }
  PaintScene scene(kReddened);
  Stage stage(scene.meshes, kPaintSide, kPaintSide);
  DrawList bare = scene.withPaint;
  bare.transparent.back().paint = 0;
  const Picture before = stage.draw(bare);
  for (std::size_t i = 0; i < paints.size(); ++i) {
    scene.withPaint.paints[1] = paints[i];
    EXPECT_EQ(stage.draw(scene.withPaint), expected[i]) << i;
    EXPECT_EQ(stage.draw(bare), before) << "the mesh of the file keeps its materials";
  }
}

TEST(PaintDrawing, NeighboursOfOneMeshHaveTheirOwnPaints) {
  PaintScene scene(kGlowing);
  const PaintScene red(kReddened);
  for (DrawList* list : {&scene.withPaint, &scene.withMesh}) list->transparent[0].model[3] = -0.8f;
  const MeshId baked = [&] {
    auto mesh = std::make_unique<Mesh>(*red.meshes.find(red.withMesh.transparent[0].mesh));
    mesh->hash ^= 815;
    return scene.meshes.add(std::move(mesh));
  }();
  scene.withPaint.transparent.push_back(place(scene.bare, standingAt(0.4, 0, 0)));
  scene.withPaint.transparent.back().paint = 1;
  scene.withMesh.transparent.push_back(place(baked, standingAt(0.4, 0, 0)));
  for (DrawList* list : {&scene.withPaint, &scene.withMesh})
    list->transparent.push_back(place(scene.bare, standingAt(0, 0.5, 0.8)));
  EXPECT_EQ(drawnByCpu(scene.meshes, scene.withPaint, kPaintSide, kPaintSide),
            drawnByCpu(scene.meshes, scene.withMesh, kPaintSide, kPaintSide));
  EXPECT_EQ(drawnByOpenGl(scene.meshes, scene.withPaint, kPaintSide, kPaintSide),
            drawnByOpenGl(scene.meshes, scene.withMesh, kPaintSide, kPaintSide));
}

TEST(PaintDrawing, ANumberBeyondTheListIsDrawnWithoutPaint) {
  const PaintScene scene(kFaint);
  DrawList beyond = scene.withPaint, bare = scene.withPaint;
  beyond.transparent.back().paint = 3;
  bare.transparent.back().paint = 0;
  EXPECT_EQ(drawnByCpu(scene.meshes, beyond, kPaintSide, kPaintSide),
            drawnByCpu(scene.meshes, bare, kPaintSide, kPaintSide));
  EXPECT_EQ(drawnByOpenGl(scene.meshes, beyond, kPaintSide, kPaintSide),
            drawnByOpenGl(scene.meshes, bare, kPaintSide, kPaintSide));
}

/// The processor draws small objects and leaves out triangles: without painted objects.
TEST(PaintDrawing, ThePlainLookOfASoftwareContextShowsPaint) {
  auto box = MeshMaker(matt(0.8f, 0.8f, 0.8f)).box({-0.4, -0.4, 0}, {0.4, 0.4, 0.8}).seal();
  MeshStore meshes;
  const MeshId id = meshes.add(std::move(box));
  DrawList list = plainList();
  list.views[0] = lookAt(Vec3(1.2, -2.2, 1.2), Vec3(0, 0, 0.4), 0.9, 1);
  list.opaque.push_back(place(id));
  const Picture bare = drawnByOpenGl(meshes, list, kPaintSide, kPaintSide, RenderQuality::plain());
  list.opaque[0].paint = 1;
  list.paints = {kReddened};
  const Picture red = drawnByOpenGl(meshes, list, kPaintSide, kPaintSide, RenderQuality::plain());
  const auto* p = bare.at(kPaintSide / 2, kPaintSide / 2);
  const auto* q = red.at(kPaintSide / 2, kPaintSide / 2);
  EXPECT_EQ(p[0], q[0]);
  EXPECT_LT(q[1], p[1] * 3 / 4);
  EXPECT_LT(q[2], q[1]);
}

TEST(MeshPaints, APaintIsMadeOnceAndForgottenWhenUnused) {
  MeshStore store;
  const MeshId id = store.add(crate());
  const Mesh& mesh = *store.find(id);
  const auto bare = std::make_shared<const CpuMesh>(mesh, Look::Full);
  MeshPaints paints(Look::Full);
  paints.begin(1);
  const auto first = paints.find(mesh, bare, kFaint);
  EXPECT_TRUE(first->seeThrough);
  EXPECT_EQ(paints.find(mesh, bare, kFaint), first);
  EXPECT_NE(paints.find(mesh, bare, kReddened), first);
  EXPECT_EQ(paints.size(), 2u);
  paints.begin(2);
  EXPECT_EQ(paints.find(mesh, bare, kFaint), first);
  paints.begin(3);
  EXPECT_EQ(paints.size(), 1u);
  paints.begin(300);
  EXPECT_EQ(paints.size(), 0u);
  paints.find(mesh, bare, kFaint);
  paints.begin(0);  // the show restarts
  EXPECT_EQ(paints.size(), 0u);
}

TEST(ThreadsMeshPaints, ManyThreadsGetOnePaint) {
  MeshStore store;
  const MeshId id = store.add(crate());
  const Mesh& mesh = *store.find(id);
  const auto bare = std::make_shared<const CpuMesh>(mesh, Look::Full);
  MeshPaints paints(Look::Full);
  for (std::uint64_t frame = 1; frame < 40; ++frame) {
    PaintRecord paint = kFaint;
    paint.opacity = 0.02f * static_cast<float>(frame);
    std::array<std::shared_ptr<const MeshPaint>, 4> got;
    std::vector<std::thread> threads;
    for (auto& mine : got)
      threads.emplace_back([&] {
        paints.begin(frame);
        mine = paints.find(mesh, bare, paint);
      });
    for (std::thread& t : threads) t.join();
    for (const auto& one : got) EXPECT_EQ(one, got[0]);
  }
}

}  // namespace
}  // namespace stadion::test
