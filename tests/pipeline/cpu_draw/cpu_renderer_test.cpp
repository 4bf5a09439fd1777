/// The CPU renderer draws what the OpenGL renderer draws, and the same pixels on every processor.

#include "engine/base/run_stopped.h"
#include "pipeline/cpu_draw/kernels/choose_kernels.h"
#include "tests/pipeline/cpu_draw/compared_pictures.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace stadion {
namespace {

using test::difference;
using test::drawnByCpu;
using test::drawnByOpenGl;
using test::matt;
using test::MeshMaker;
using test::Picture;
using test::PictureDifference;

constexpr std::uint32_t kCpuWidth = 203, kCpuHeight = 149;
constexpr double kCpuAspect = double{kCpuWidth} / kCpuHeight;

Affine standing(double x, double y, double z) {
  Affine X = Affine::Identity();
  X.translation() = Vec3(x, y, z);
  return X;
}

/// Edges differ where OpenGL moves corners to a grid of 1/256 pixel; textures by the rounding of filters.
void expectAlike(const Picture& cpu, const Picture& gl, const std::string& name, double mean = 0.3,
                 double alike = 0.995) {
  const PictureDifference d = difference(cpu, gl);
  EXPECT_LE(d.mean, mean) << name << ", greatest " << d.most;
  EXPECT_GE(d.alike, alike) << name << ", greatest " << d.most;
  if (d.mean <= mean && d.alike >= alike) return;
  test::writePng(cpu, name + "-cpu"), test::writePng(gl, name + "-gl");
}

/// Triangles everywhere: in front of the eye, behind it, and through the near plane.
std::unique_ptr<Mesh> soup(unsigned seed, int triangles) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> within(-1, 1);
  MeshMaker maker(matt(0.6f, 0.5f, 0.3f));
  const auto point = [&](double size) {
    return Vec3(size * within(random), size * within(random), size * within(random));
  };
  for (int i = 0; i < triangles; ++i) {
    const Vec3 at = point(8);
    const double size = std::exp(3 * within(random) - 1);
    maker.triangle(at + point(size), at + point(size), at + point(size));
  }
  return maker.seal();
}

DrawList sunny() {
  DrawList list = test::plainList();
  list.views[0] = test::lookAt(Vec3(0, -6, 1.7), Vec3(0, 0, 0.9), 1.1, kCpuAspect);
  list.sky = {};
  DrawLight sun;
  sun.direction = {-0.45f, 0.35f, -0.82f};
  list.lights = {sun};
  return list;
}

TEST(CpuRenderer, DrawsARichListAsOpenGlDoes) {
  MeshStore meshes;
  const DrawList list = test::richList(meshes, kCpuAspect);
  for (const std::uint32_t view : {0u, 1u})
    expectAlike(drawnByCpu(meshes, list, kCpuWidth, kCpuHeight, {}, 2, nullptr, view),
                drawnByOpenGl(meshes, list, kCpuWidth, kCpuHeight, {}, view), "rich" + std::to_string(view));
}

/// Lamps and spots whose light falls off with the square of the distance.
TEST(CpuRenderer, DrawsLightsThatFallOffAsOpenGlDoes) {
  MeshStore meshes;
  DrawList list = test::richList(meshes, kCpuAspect);
  const Picture before = drawnByCpu(meshes, list, kCpuWidth, kCpuHeight);
  for (DrawLight& light : list.lights) light.fallsOff = light.kind != DrawLight::Kind::Directional;
  const Picture cpu = drawnByCpu(meshes, list, kCpuWidth, kCpuHeight);
  EXPECT_GT(difference(cpu, before).mean, 0.2);
  expectAlike(cpu, drawnByOpenGl(meshes, list, kCpuWidth, kCpuHeight), "falling-off");
  expectAlike(drawnByCpu(meshes, list, kCpuWidth, kCpuHeight, PictureRung::of(RenderQuality::plain())),
              drawnByOpenGl(meshes, list, kCpuWidth, kCpuHeight, RenderQuality::plain()), "plain falling-off",
              0.5, 0.985);
}

TEST(CpuRenderer, DrawsThePlainLookAsOpenGlDoes) {
  MeshStore meshes;
  const DrawList list = test::richList(meshes, kCpuAspect);
  expectAlike(drawnByCpu(meshes, list, kCpuWidth, kCpuHeight, PictureRung::of(RenderQuality::plain())),
              drawnByOpenGl(meshes, list, kCpuWidth, kCpuHeight, RenderQuality::plain()), "plain", 0.5,
              0.985);
}

TEST(CpuRenderer, ClipsAtTheNearPlaneAsOpenGlDoes) {
  MeshStore meshes;
  DrawList list = sunny();
  list.opaque = {test::place(meshes.add(soup(1, 300)), standing(0, -4, 1))};
  expectAlike(drawnByCpu(meshes, list, kCpuWidth, kCpuHeight),
              drawnByOpenGl(meshes, list, kCpuWidth, kCpuHeight), "soup", 0.5, 0.99);
}

TEST(CpuRenderer, DrawsAParallelProjectionAsOpenGlDoes) {
  MeshStore meshes;
  DrawList list = test::plainList();
  list.opaque = {
      test::place(meshes.add(MeshMaker(matt(0.7f, 0.2f, 0.1f)).sphere(0.7, 12).seal())),
      test::place(meshes.add(MeshMaker(matt(0.1f, 0.2f, 0.7f)).box({-0.9, -0.2, -0.9}, {0, 0.2, 0}).seal()))};
  expectAlike(drawnByCpu(meshes, list, kCpuWidth, kCpuHeight),
              drawnByOpenGl(meshes, list, kCpuWidth, kCpuHeight), "parallel");
}

TEST(CpuRenderer, SortsTransparentSurfacesAsOpenGlDoes) {
  MeshStore meshes;
  DrawList list = sunny();
  list.opaque = {
      test::place(meshes.add(MeshMaker(matt(0.5f, 0.5f, 0.5f)).sphere(0.6, 12).seal()), standing(0, 0, 0.9))};
  std::mt19937 random(4);
  std::uniform_real_distribution<double> within(-1, 1);
  for (int i = 0; i < 12; ++i) {
    const auto part = [&] { return static_cast<float>(0.5 + 0.5 * within(random)); };
    Affine X = standing(0.5 * within(random), within(random), 0.9);
    X.linear() = Eigen::AngleAxisd(3 * within(random), Vec3(within(random), within(random), 1).normalized())
                     .toRotationMatrix();
    MeshMaker pane(matt(part(), part(), part(), 0.4f));
    pane.quad({-1, 0, -0.7}, {1, 0, -0.7}, {1, 0, 0.7}, {-1, 0, 0.7});
    list.transparent.push_back(test::place(meshes.add(pane.seal()), X));
  }
  expectAlike(drawnByCpu(meshes, list, kCpuWidth, kCpuHeight),
              drawnByOpenGl(meshes, list, kCpuWidth, kCpuHeight), "glass", 0.5, 0.99);
}

TEST(CpuRenderer, CutsOutWhatTheMaterialCutsOut) {
  MeshStore meshes;
  DrawList list = sunny();
  Texture holes = test::chequered(64, 8);
  for (std::size_t i = 0; i < holes.rgba.size(); i += 4) holes.rgba[i + 3] = holes.rgba[i] > 200 ? 255 : 0;
  Material fence = matt(1, 1, 1);
  fence.alphaCutoff = 0.5f, fence.partlyTransparent = true;
  MeshMaker maker(fence);
  maker.texture(holes).quad({-1.5, 0, 0}, {1.5, 0, 0}, {1.5, 0, 2}, {-1.5, 0, 2});
  list.opaque = {test::place(meshes.add(maker.seal()))};
  expectAlike(drawnByCpu(meshes, list, kCpuWidth, kCpuHeight),
              drawnByOpenGl(meshes, list, kCpuWidth, kCpuHeight), "fence", 0.6, 0.98);
}

TEST(CpuRenderer, GivesTheSamePixelsWithAllKernelsAndAnyNumberOfThreads) {
  MeshStore meshes;
  DrawList list = test::richList(meshes, kCpuAspect);
  list.opaque.push_back(test::place(meshes.add(soup(2, 200)), standing(0, -4, 1)));
  for (const int samples : {1, 4, 8})
    for (const bool plain : {false, true}) {
      PictureRung rung;
      rung.samples = samples, rung.look = plain ? Look::Plain : Look::Full;
      rung.coarse = samples == 8, rung.nearestLevel = samples == 1;
      const Picture first = drawnByCpu(meshes, list, kCpuWidth, kCpuHeight, rung, 1, &kDrawByFour);
      for (const DrawKernels* kernels : drawKernelsHere())
        for (const std::size_t threads : {1u, 3u, 8u})
          EXPECT_EQ(drawnByCpu(meshes, list, kCpuWidth, kCpuHeight, rung, threads, kernels), first)
              << kernels->name << ", " << threads << " threads, " << samples << " samples";
    }
}

TEST(CpuRenderer, SurvivesGeometryOfAllKinds) {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN(),
                  kInf = std::numeric_limits<float>::infinity();
  const float odd[] = {kNan, kInf, -kInf, 3e38f, -3e38f, 1e20f, 1e-40f, 0};
  std::mt19937 random(5);
  for (int round = 0; round < 30; ++round) {
    MeshStore meshes;
    DrawList list = sunny();
    auto mesh = soup(static_cast<unsigned>(round), 60);
    for (int k = 0; k < 40; ++k) {
      const std::size_t v = random() % mesh->positions.size();
      mesh->positions[v][random() % 3] = odd[random() % 8];
      mesh->normals[v][random() % 3] = odd[random() % 8], mesh->uvs[v][random() % 2] = odd[random() % 8];
    }
    mesh->textures.push_back(test::chequered(16, 4)), mesh->materials[0].maps[kBaseMap].texture = 0;
    list.opaque = {test::place(meshes.add(std::move(mesh)), standing(0, -4, 1))};
    if (round % 3 == 0) list.opaque[0].model[random() % 12] = odd[3 + random() % 5];
    if (round % 2 == 0) std::swap(list.transparent, list.opaque);
    const Picture first = drawnByCpu(meshes, list, 64, 48, {}, 1, &kDrawByFour);
    for (const DrawKernels* kernels : drawKernelsHere())
      EXPECT_EQ(drawnByCpu(meshes, list, 64, 48, {}, 2, kernels), first)
          << kernels->name << ", round " << round;
  }
}

TEST(CpuRenderer, LeavesOutWhatIsNotFiniteAndReportsItOnce) {
  MeshStore meshes;
  DrawList list = sunny();
  list.opaque = {test::place(meshes.add(MeshMaker(matt(1, 0, 0)).sphere(0.5, 8).seal()))};
  list.opaque[0].model[3] = std::numeric_limits<float>::quiet_NaN();
  DrawPool pool(1);
  CpuRoom room(meshes, Look::Full, pool);
  auto renderer = CpuRenderer::create(room, 64, 48);
  EXPECT_TRUE(renderer.value()->draw(list));
  EXPECT_FALSE(renderer.value()->draw(list));
}

TEST(CpuRenderer, StopsWhenAsked) {
  MeshStore meshes;
  const DrawList list = test::richList(meshes, kCpuAspect);
  DrawPool pool(2);
  CpuRoom room(meshes, Look::Full, pool);
  auto renderer = CpuRenderer::create(room, 64, 48);
  EXPECT_THROW(renderer.value()->draw(
                   list, [] { return true; }, nullptr),
               RunStopped);
}

}  // namespace
}  // namespace stadion
