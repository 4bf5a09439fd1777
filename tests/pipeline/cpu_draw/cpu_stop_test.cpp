/// A run that is to end does not wait for a picture, however large.

#include "engine/base/run_stopped.h"
#include "pipeline/cpu_draw/cpu_renderer.h"
#include "tests/pipeline/gl_draw/renderer_scene.h"

#include <gtest/gtest.h>

#include <atomic>

namespace stadion {
namespace {

TEST(CpuRendererStop, IsAskedForBeforeEachBand) {
  constexpr int kBands = 32;
  MeshStore meshes;
  const DrawList list = test::richList(meshes, 1);
  DrawPool pool(2);
  CpuRoom room(meshes, Look::Full, pool);
  auto renderer = CpuRenderer::create(room, 64, kBands * kBandRows);
  ASSERT_TRUE(renderer);
  std::atomic<int> asked = 0;
  const auto never = [&] { return ++asked < 0; };
  renderer.value()->draw(list, never, nullptr);
  EXPECT_GE(asked, kBands * static_cast<int>(list.viewCount));
  constexpr int kUntil = kBands / 2;
  asked = 0;
  EXPECT_THROW(renderer.value()->draw(
                   list, [&] { return ++asked > kUntil; }, nullptr),
               RunStopped);
  EXPECT_LE(asked, kUntil + 2) << "once by each thread";
  asked = 0;
  renderer.value()->draw(list, never, nullptr);
  EXPECT_GE(asked, kBands * static_cast<int>(list.viewCount)) << "it draws again";
}

}  // namespace
}  // namespace stadion
