// Walls that are drawn on processors of their own.
#include "pipeline/process/per_wall_process_renderer.h"
#include "pipeline/wall/gl_wall_renderer.h"
#include "tests/pipeline/gl_draw/renderer_scene.h"
#include "tests/proc.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <optional>
#include <sched.h>
#include <thread>

namespace stadion {
namespace {

constexpr std::uint32_t kPinnedWidth = 48, kPinnedHeight = 36;

/// Nothing if the thread has ended.
std::optional<ProcessorSet> processorsOf(pid_t thread) {
  cpu_set_t set;
  CPU_ZERO(&set);
  if (sched_getaffinity(thread, sizeof set, &set) != 0) return {};
  ProcessorSet found;
  for (std::size_t i = 0; i < ProcessorSet::kMost; ++i)
    if (CPU_ISSET(i, &set)) found.add(i);
  return found;
}

/// Of those that this test may use, the first.
ProcessorSet oneProcessor() {
  const ProcessorSet mine = processorsOfThisThread();
  ProcessorSet one;
  for (std::size_t i = 0; one.empty() && i < ProcessorSet::kMost; ++i)
    if (mine.contains(i)) one.add(i);
  return one;
}

/// The threads of a process.
std::vector<pid_t> threadsOf(pid_t process) {
  return procNumbers("/proc/" + std::to_string(process) + "/task");
}

/// Mesa sees to it that the thread of its cache of programs is bound nowhere.
bool ofTheCache(pid_t process, pid_t thread) {
  return procText(process, "task/" + std::to_string(thread) + "/comm").find("disk$") != std::string::npos;
}

TEST(PinnedWalls, ProcessesRunWhereTheyAreToldToWithAllTheirThreads) {
  MeshStore meshes;
  const DrawList list = test::richList(meshes, double{kPinnedWidth} / kPinnedHeight);
  PerWallProcessParts parts{.meshes = meshes, .walls = {}, .names = {}};
  parts.walls = {{kPinnedWidth, kPinnedHeight}, {kPinnedWidth, kPinnedHeight}};
  parts.names = {"bound", "free"};
  parts.rasteriserThreads = 2;
  parts.program = std::filesystem::path(STADION_BINARY_DIR) / "bin" / "stadion-wall";
  parts.processors = {oneProcessor()};
  PerWallProcessRenderer drawing(std::move(parts));
  for (const std::size_t wall : {0, 1}) {
    const Failure opened = drawing.open(wall);
    ASSERT_FALSE(opened) << opened->message;
    EXPECT_FALSE(drawing.draw(wall, list, true).failure);
  }
  std::size_t bound = 0;
  for (const pid_t thread : threadsOf(drawing.pid(0))) {
    const auto processors = processorsOf(thread);
    if (!processors || ofTheCache(drawing.pid(0), thread)) continue;
    EXPECT_EQ(*processors, oneProcessor());
    ++bound;
  }
  EXPECT_GE(bound, 3u);  // the rasteriser's two as well
  EXPECT_EQ(processorsOf(drawing.pid(1)), processorsOfThisThread());
  drawing.close(0), drawing.close(1);
}

TEST(PinnedWalls, OnlyTheThreadThatDrawsAWallIsBoundNotTheRasterisersThatAllWallsShare) {
  const ProcessorSet before = processorsOfThisThread();
  MeshStore meshes;
  const DrawList list = test::richList(meshes, double{kPinnedWidth} / kPinnedHeight);
  GlWallRendererParts parts{*test::provider(GlProviderKind::OsMesa), meshes, {{kPinnedWidth, kPinnedHeight}}};
  parts.processors = {oneProcessor()};
  GlWallRenderer drawing(std::move(parts));
  std::thread([&] {
    const Failure opened = drawing.open(0);
    ASSERT_FALSE(opened) << opened->message;
    EXPECT_EQ(processorsOfThisThread(), oneProcessor());
    EXPECT_FALSE(drawing.draw(0, list, true).failure);
    drawing.close(0);
  }).join();
  for (const pid_t thread : threadsOf(getpid()))
    EXPECT_EQ(processorsOf(thread).value_or(before), before) << thread;
}

}  // namespace
}  // namespace stadion
