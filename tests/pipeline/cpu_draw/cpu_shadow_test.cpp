/// Shadows of the CPU renderer: as OpenGL draws them, and independent of what was drawn before.

#include "pipeline/cpu_draw/kernels/choose_kernels.h"
#include "tests/pipeline/cpu_draw/compared_pictures.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <thread>

namespace stadion {
namespace {

using test::matt;
using test::MeshMaker;
using test::Picture;

constexpr std::uint32_t kShadowWidth = 203, kShadowHeight = 149;

/// A ground with crates under a sun; one more crate moves.
struct ShadowedYard {
  MeshStore meshes;
  MeshId ground, crate;

  ShadowedYard() {
    ground = meshes.add(MeshMaker(matt(0.5f, 0.5f, 0.5f))
                            .quad({-50, -50, 0}, {50, -50, 0}, {50, 50, 0}, {-50, 50, 0})
                            .seal());
    crate = meshes.add(MeshMaker(matt(0.6f, 0.3f, 0.2f)).box({-0.5, -0.5, 0}, {0.5, 0.5, 1}).seal());
  }
  static DrawItem at(MeshId mesh, double x, double y, double z) {
    Affine X = Affine::Identity();
    X.translation() = Vec3(x, y, z);
    return test::place(mesh, X);
  }
  /// The moving crate stands at x; the rings lie around the list's origin.
  DrawList list(double x, std::uint64_t movingKey) const {
    DrawList out = test::plainList();
    out.views[0] = test::lookAt(Vec3(0, -8, 4), Vec3(0, 0, 0), 0.9, double{kShadowWidth} / kShadowHeight);
    out.sky = {};
    DrawLight sun;
    const Vec3 towards = Vec3(-0.6, 0.1, 0.8).normalized();
    const Vec3 right = Vec3(0, 0, 1).cross(towards).normalized(), up = towards.cross(right);
    for (int k = 0; k < 3; ++k) sun.direction[static_cast<std::size_t>(k)] = static_cast<float>(-towards[k]);
    sun.shadows = true;
    out.lights = {sun};
    const auto still = std::make_shared<const std::vector<DrawItem>>(
        std::vector{at(ground, 0, 0, 0), at(crate, -1, 0, 0), at(crate, 1.5, 1, 0.7), at(crate, 3, 20, 0)});
    const DrawItem moves = at(crate, x, -2, 0.3);
    out.opaque = *still;
    out.opaque.push_back(moves);
    out.shadows.light = 0;
    for (int k = 0; k < 3; ++k) {
      const auto i = static_cast<std::size_t>(k);
      out.shadows.axes[i] = static_cast<float>(right[k]), out.shadows.axes[3 + i] = static_cast<float>(up[k]);
      out.shadows.axes[6 + i] = static_cast<float>(towards[k]);
    }
    for (DrawShadowRing& ring : out.shadows.rings)
      ring.still = still, ring.moving = {moves}, ring.stillKey = 7, ring.movingKey = movingKey,
      ring.movingArea = {-1, -1, 1, 1};
    return out;
  }
};

TEST(CpuShadows, LookAsWithOpenGl) {
  const ShadowedYard yard;
  const DrawList list = yard.list(-2, 1);
  const Picture cpu = test::drawnByCpu(yard.meshes, list, kShadowWidth, kShadowHeight);
  const Picture gl = test::drawnByOpenGl(yard.meshes, list, kShadowWidth, kShadowHeight);
  const test::PictureDifference d = test::difference(cpu, gl);
  EXPECT_LE(d.mean, 0.3) << d.most;
  EXPECT_GE(d.alike, 0.995) << d.most;
}

TEST(CpuShadows, DarkenTheGroundBehindACrate) {
  const ShadowedYard yard;
  DrawList list = yard.list(-2, 1);
  const Picture with = test::drawnByCpu(yard.meshes, list, kShadowWidth, kShadowHeight);
  list.shadows.light = -1;
  const Picture without = test::drawnByCpu(yard.meshes, list, kShadowWidth, kShadowHeight);
  int darker = 0;
  for (std::size_t i = 0; i < with.rgba.size(); ++i) {
    EXPECT_LE(with.rgba[i], without.rgba[i]);
    darker += with.rgba[i] + 20 < without.rgba[i];
  }
  EXPECT_GT(darker, 1000);
}

TEST(CpuShadows, DoNotDependOnWhatWasDrawnBefore) {
  const ShadowedYard yard;
  DrawPool pool(2);
  CpuRoom room(yard.meshes, Look::Full, pool);
  auto renderer = CpuRenderer::create(room, kShadowWidth, kShadowHeight);
  Picture kept{kShadowWidth, kShadowHeight,
               std::vector<std::uint8_t>(std::size_t{kShadowWidth} * kShadowHeight * 4)};
  for (const int frame : {0, 1, 2, 5, 3, 3, 0, 8}) {
    const DrawList list = yard.list(-3 + 0.7 * frame, static_cast<std::uint64_t>(1 + frame));
    ASSERT_FALSE(renderer.value()->draw(list));
    ASSERT_FALSE(renderer.value()->read(0, kept.rgba));
    for (const DrawKernels* kernels : drawKernelsHere())
      ASSERT_EQ(kept, test::drawnByCpu(yard.meshes, list, kShadowWidth, kShadowHeight, {}, 3, kernels))
          << frame;
  }
}

TEST(CpuShadows, OfWallsThatDrawDifferentFramesStayApart) {
  const ShadowedYard yard;
  DrawPool pool(2);
  CpuRoom room(yard.meshes, Look::Full, pool);
  constexpr int kFrames = 12;
  std::array<std::vector<Picture>, 2> drawn;
  std::vector<std::thread> walls;
  for (std::size_t wall = 0; wall < 2; ++wall)
    walls.emplace_back([&, wall] {
      auto renderer = CpuRenderer::create(room, 80, 60);
      for (int frame = 0; frame < kFrames; ++frame) {
        renderer.value()->draw(yard.list(-3 + 0.5 * frame, static_cast<std::uint64_t>(1 + frame)));
        Picture& picture = drawn[wall].emplace_back(Picture{80, 60, std::vector<std::uint8_t>(80 * 60 * 4)});
        renderer.value()->read(0, picture.rgba);
      }
    });
  for (std::thread& t : walls) t.join();
  EXPECT_EQ(drawn[0], drawn[1]);
}

}  // namespace
}  // namespace stadion
