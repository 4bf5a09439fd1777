/// Walls that are drawn without OpenGL.

#include "pipeline/draw_list/list_filling.h"
#include "pipeline/wall/cpu_wall_renderer.h"
#include "tests/pipeline/cpu_draw/compared_pictures.h"

#include <gtest/gtest.h>

#include <thread>

namespace stadion {
namespace {

using test::Picture;

TEST(CpuWallRenderer, DrawsWhatACpuRendererDrawsAlone) {
  MeshStore meshes;
  const DrawList list = test::richList(meshes, 80.0 / 60);
  DrawPool pool(2);
  CpuWallRenderer walls({meshes, pool, {{80, 60}, {64, 48}}});
  std::vector<Picture> drawn{{80, 60, std::vector<std::uint8_t>(80 * 60 * 4)},
                             {64, 48, std::vector<std::uint8_t>(64 * 48 * 4)}};
  std::vector<std::thread> threads;
  for (std::size_t wall = 0; wall < 2; ++wall)
    threads.emplace_back([&, wall] {
      EXPECT_FALSE(walls.open(wall));
      EXPECT_FALSE(walls.warmUp(wall, list));
      const DrawOutcome outcome = walls.draw(wall, list, true);
      EXPECT_TRUE(outcome.drawn && !outcome.failure);
      EXPECT_FALSE(walls.read(wall, 1, drawn[wall].rgba));
    });
  for (std::thread& t : threads) t.join();
  for (const Picture& p : drawn)
    EXPECT_EQ(p, test::drawnByCpu(meshes, list, p.width, p.height, {}, 1, nullptr, 1));
  EXPECT_EQ(walls.totals(0)[1].frames, 1u);
  for (const std::size_t wall : {0u, 1u}) walls.close(wall);
}

TEST(CpuWallRenderer, WaitsForAListThatIsStillFilledAndSkipsAVoidOne) {
  MeshStore meshes;
  DrawList list = test::richList(meshes, 80.0 / 60);
  for (const bool isVoid : {false, true}) {
    ListFilling filling([] {}, true);
    filling.restart(), filling.begin();
    list.filling = &filling;
    DrawPool pool(1);
    CpuWallRenderer walls({meshes, pool, {{80, 60}}});
    EXPECT_FALSE(walls.open(0));
    std::thread cull([&] { filling.finish(isVoid); });
    EXPECT_EQ(walls.draw(0, list, true).drawn, !isVoid);
    cull.join();
    walls.close(0);
  }
}

TEST(CpuWallRenderer, RefusesAPictureThatIsTooLarge) {
  MeshStore meshes;
  DrawPool pool(1);
  CpuWallRenderer walls({meshes, pool, {{100000, 10}}});
  EXPECT_TRUE(walls.open(0));
}

}  // namespace
}  // namespace stadion
