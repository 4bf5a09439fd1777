/// A live show with real walls, one of which is slow: App does not wait for it, whatever draws the walls.

#include "pipeline/target/target.h"
#include "tests/pipeline/loop/app_progress.h"
#include "tests/programs/program.h"
#include "tests/show/player/played_show.h"

#include <gtest/gtest.h>

namespace stadion {
namespace {

/// The stages of a real show. Cull of the first wall goes on only once App has begun further frames.
class UnevenShow final : public Stages {
public:
  UnevenShow(ShowParts parts, AppProgress& progress) : progress_(progress), show_(std::move(parts)) {}

  void app(const TimeSignature& now, std::size_t slot) override {
    show_.app(now, slot);
    progress_.reached(now.frame);
  }
  void cull(std::size_t wall, std::size_t slot, DrawList& list) override {
    show_.cull(wall, slot, list);
    if (wall == 0 && list.ticket.signature.frame > 0 && !progress_.goesOn(20)) held = true;
  }
  Failure openWall(std::size_t wall) override { return show_.openWall(wall); }
  Failure warmUp(std::size_t wall, const DrawList& list) override { return show_.warmUp(wall, list); }
  Failure draw(std::size_t wall, const DrawList& list) override { return show_.draw(wall, list); }
  void closeWall(std::size_t wall) override { show_.closeWall(wall); }
  Failure swap(const TimeSignature& now) override { return ++shown, show_.swap(now); }

  std::atomic<bool> held = false;
  std::size_t shown = 0;

private:
  AppProgress& progress_;
  ShowStages show_;
};

class ProgramUnevenWalls : public testing::TestWithParam<bool> {};

TEST_P(ProgramUnevenWalls, DoNotHoldApp) {
  constexpr std::uint64_t kUnevenFrames = 240;
  const auto player = openShow(testShow("bodies.evs"), "cave4");
  ASSERT_TRUE(player);
  auto provider = openGlProvider(GlProviderKind::OsMesa);
  ASSERT_TRUE(provider) << provider.error().message;
  ShowParts parts = player->parts(StereoLayout::Off);
  parts.provider = provider.value().get();
  parts.quality.look = Look::Plain;
  if (GetParam()) {
    parts.wallProcesses.emplace();
    parts.wallProcesses->rasteriserThreads = 1, parts.wallProcesses->everyFrame = false;
    parts.wallProcesses->tell = [](const std::string&) {};
  }
  FrameLoopOptions o;
  o.walls = parts.walls.size(), o.frames = kUnevenFrames, o.rate = 200;
  o.pace = Pace::Lock, o.delivery = Delivery::Latest;
  AppProgress progress(kUnevenFrames);
  UnevenShow stages(std::move(parts), progress);
  const std::atomic<bool> never = false;
  FrameLoop loop(stages, o, never, &progress);
  const FrameLoopOutcome outcome = loop.run();
  EXPECT_FALSE(outcome.failure) << outcome.failure->message;
  EXPECT_FALSE(stages.held);
  EXPECT_GT(stages.shown, 3U);
}

INSTANTIATE_TEST_SUITE_P(Drawn, ProgramUnevenWalls, testing::Bool(),
                         [](const auto& workers) { return workers.param ? "processes" : "threads"; });

}  // namespace
}  // namespace stadion
