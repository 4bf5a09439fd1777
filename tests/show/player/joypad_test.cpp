/// A joypad scales force fields: the same log gives the same motion at any frame rate.

#include "tests/show/player/played_show.h"

#include "dynamics/nodes/dyn_object_node.h"
#include "tests/programs/program.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace stadion {
namespace {

struct Ends {
  Vec3 rolls = Vec3::Zero(), flies = Vec3::Zero();
};

/// Where the two balls are after three seconds.
Ends playJoypad(double rate) {
  Ends ends;
  ShowOptions options;
  options.script = testShow("joypad.evs"), options.walls = "desktop", options.size = "64x48";
  options.rate = rate, options.assetRoots = {assetFolder()};
  Diagnostics findings;
  if (!options.complete(findings)) return ends;
  const auto player = Player::create(options, findings);
  printFindings(findings);
  if (!player) return ends;
  const auto ball = [&](const char* name) {
    const Node* node = player->scene().find(player->scene().tree().resolve(name, {1, 0}));
    return dynamic_cast<const DynObjectNode&>(*node).state().p;
  };
  ShowStages stages(player->parts(StereoLayout::Pair));
  play(stages, Mode::Sequential, 1, static_cast<std::uint64_t>(3 * rate) + 1, rate);
  ends.rolls = ball("rolls"), ends.flies = ball("flies");
  return ends;
}

TEST(Joypad, TheSameLogGivesTheSameMotionAtAnyFrameRate) {
  const Ends a = playJoypad(30);
  EXPECT_GT(a.rolls.x(), -4) << "it was pushed";
  EXPECT_GT(a.flies.y(), 0.5) << "it was blown away";
  for (const double rate : {60., 144., 240.}) {
    const Ends b = playJoypad(rate);
    fmt::print("{:3.0f} Hz against 30 Hz: on the ground {:.2g} m, in the air {:.2g} m apart\n", rate,
               (a.rolls - b.rolls).norm(), (a.flies - b.flies).norm());
    EXPECT_LT((a.rolls - b.rolls).norm(), 1e-5);
    EXPECT_LT((a.flies - b.flies).norm(), 1e-6);
  }
}

}  // namespace
}  // namespace stadion
