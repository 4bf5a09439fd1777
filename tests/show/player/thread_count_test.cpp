#include "show/player/thread_count.h"

#include <gtest/gtest.h>

namespace stadion {
namespace {

TEST(ThreadCount, CountsStagesOfEachWallAndTheRasteriser) {
  const ThreadCount here = threadsOf({false, 2, false}, 4);
  EXPECT_EQ(here.all(), 1u + 4 + 4 + 2) << "the walls of one program share the rasteriser's threads";
  const ThreadCount processes = threadsOf({true, 2, false}, 4);
  EXPECT_EQ(processes.all(), 1u + 4 + 4 + 8) << "each process has its own";
}

TEST(ThreadCount, GivesAdviceOnlyIfThreadsShareProcessors) {
  const ThreadCount threads = threadsOf({false, 2, false}, 4);
  EXPECT_EQ(textOf(threads, 2, "cave4"),
            "threads: 1 App, 4 Cull, 4 Draw, 2 of the software rasteriser: 11 for 2 processors\n"
            "They take turns, so walls wait for each other. stadion calibrate finds the fastest split here;\n"
            "stadion plan SHOW --walls cave4 --cores 11 predicts a machine with a processor for each.\n");
  EXPECT_EQ(textOf(threads, 11, "cave4"),
            "threads: 1 App, 4 Cull, 4 Draw, 2 of the software rasteriser: 11 for 11 processors\n");
}

TEST(ThreadCount, TheCpuRendererCountsDrawAmongItsThreads) {
  const ThreadCount threads = threadsOfCpuRenderer(2, 4);
  EXPECT_EQ(threads.all(), 1u + 4 + 2);
  EXPECT_EQ(textOf(threads, 8, "cave4"),
            "threads: 1 App, 4 Cull, 2 of the CPU renderer, which draw all walls: 7 for 8 processors\n");
}

}  // namespace
}  // namespace stadion
