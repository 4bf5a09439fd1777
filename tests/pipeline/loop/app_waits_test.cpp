/// In a live show, App never waits for a wall, however slow one is and however fast the others are.

#include "tests/pipeline/loop/app_progress.h"
#include "tests/pipeline/loop/counting_stages.h"

#include <gtest/gtest.h>

namespace stadion {
namespace {

/// Cull of the slow walls goes on only once App has begun many further frames.
class UnevenCull final : public CountingStages {
public:
  UnevenCull(std::size_t walls, std::size_t slow, AppProgress& progress)
      : CountingStages(walls, kSlots), slow_(slow), progress_(progress) {}

  void app(const TimeSignature& now, std::size_t slot) override {
    CountingStages::app(now, slot);
    progress_.reached(now.frame);
  }
  void cull(std::size_t wall, std::size_t slot, DrawList& list) override {
    CountingStages::cull(wall, slot, list);
    // App waits for the first picture: before that no time passes.
    if (wall < slow_ && list.ticket.signature.frame > 0 && !progress_.goesOn(30)) held = true;
  }

  std::atomic<bool> held = false;

private:
  std::size_t slow_;
  AppProgress& progress_;
};

TEST(ThreadsFrameLoop, AppOfALiveShowNeverWaitsForASlowWall) {
  constexpr std::uint64_t kFrames = 600;
  struct Room {
    std::size_t walls, slow;
  };
  for (const Room room : {Room{2, 1}, Room{6, 1}, Room{6, 5}, Room{24, 12}})
    for (const bool early : {true, false}) {
      AppProgress progress(kFrames);
      UnevenCull stages(room.walls, room.slow, progress);
      FrameLoopOptions o;
      o.walls = room.walls, o.frames = kFrames, o.rate = 1000;
      o.pace = Pace::Lock, o.delivery = Delivery::Latest, o.drawBeginsEarly = early;
      const std::atomic<bool> never = false;
      FrameLoop loop(stages, o, never, &progress);
      EXPECT_FALSE(loop.run().failure);
      EXPECT_FALSE(stages.held) << room.walls << " walls, " << room.slow << " of them slow";
      EXPECT_FALSE(stages.torn);
      EXPECT_GT(stages.shown.size(), 3U);
    }
}

}  // namespace
}  // namespace stadion
