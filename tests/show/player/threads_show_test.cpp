/// A real show in all its threads: loader, App, and for each wall Cull and Draw through OSMesa. What
/// ThreadSanitizer says of it is the test.

#include "tests/programs/program.h"
#include "tests/show/player/played_show.h"

#include <gtest/gtest.h>

namespace stadion {
namespace {

/// Takes every frame and counts them.
class CountingSink final : public PictureSink {
public:
  bool wants(const TimeSignature&) const override { return true; }
  Failure take(const TimeSignature&, const std::vector<EyePictures>& walls) override {
    ++frames;
    for (const EyePictures& w : walls) pictures += w.eyes.size();
    return {};
  }
  std::size_t frames = 0, pictures = 0;
};

void playOnFourWalls(Delivery delivery, std::uint64_t frames) {
  auto provider = openGlProvider(GlProviderKind::OsMesa);
  ASSERT_TRUE(provider);
  const auto player = openShow(testShow("moving.evs"), "cave4");
  ASSERT_TRUE(player);
  CountingSink sink;
  ShowParts parts = player->parts(StereoLayout::Pair);
  parts.provider = provider.value().get();
  parts.sink = &sink;
  ShowStages stages(std::move(parts));
  FrameLoopOptions o;
  o.walls = 4, o.frames = frames, o.delivery = delivery;
  const std::atomic<bool> never = false;
  FrameLoop loop(stages, o, never);
  const FrameLoopOutcome outcome = loop.run();
  ASSERT_FALSE(outcome.failure) << outcome.failure->message;
  EXPECT_EQ(outcome.framesSimulated, frames);
  EXPECT_EQ(sink.frames, outcome.framesShown);
  EXPECT_EQ(sink.pictures, 8 * sink.frames);
  if (delivery == Delivery::Every) {
    EXPECT_EQ(outcome.framesShown, frames);
  }
}

TEST(ThreadsShow, EveryFrameOnFourWalls) {
  playOnFourWalls(Delivery::Every, 60);
}

TEST(ThreadsShow, TheLatestFrameOnFourWalls) {
  playOnFourWalls(Delivery::Latest, 150);
}

}  // namespace
}  // namespace stadion
