/// While nothing comes, goes or happens App asks for no memory: what it needs from frame to frame it has
/// already. (What happens, a path's end for example, may be told with a message, which is memory.)

#include "profiling/record/allocations.h"
#include "tests/programs/program.h"
#include "tests/show/player/played_show.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace stadion {
namespace {

/// How often App allocates in 60 frames, after some in which its buffers grew. The visitor's devices are as
/// the log says.
std::uint64_t allocationsOfApp(const std::string& script, const std::string& log = {},
                               std::uint64_t warm = 120) {
  const TestFolder folder;
  ShowOptions options;
  options.script = script, options.walls = "cave4", options.size = "64x48";
  options.input = log.empty() ? "none" : folder.write("visitor.input", "stadion-input 1\n" + log);
  options.assetRoots = {assetFolder()};
  Diagnostics findings;
  const auto player = options.complete(findings) ? Player::create(options, findings) : nullptr;
  printFindings(findings);
  if (!player) return ADD_FAILURE() << "the show cannot be played", 0;
  ShowParts parts = player->parts(StereoLayout::Pair);
  const auto freeUnshown = std::exchange(parts.freeUnshown, {});
  ShowStages stages(std::move(parts));
  Allocations before;
  for (std::uint64_t frame = 0; frame < warm + 60; ++frame) {
    if (frame == warm) before = allocationsSoFar();
    stages.app(signatureAt(frame, 60), frame % kSlots);
    freeUnshown(frame);
  }
  return (allocationsSoFar() - before).count;
}

/// How often Draw does, on all walls, when it has seen the show for a while. What Mesa asks for itself, of C,
/// is not counted.
std::uint64_t allocationsOfDraw(const std::string& script, Look look) {
  constexpr std::uint64_t kWarm = 30, kDrawnFrames = 15;
  ShowOptions options;
  options.script = script, options.walls = "desktop", options.size = "64x48", options.look = look;
  options.input = "none", options.assetRoots = {assetFolder()};
  Diagnostics findings;
  const auto player = options.complete(findings) ? Player::create(options, findings) : nullptr;
  printFindings(findings);
  auto provider = openGlProvider(GlProviderKind::OsMesa);
  if (!player || !provider) return ADD_FAILURE() << "the show cannot be played", 0;
  ShowParts parts = player->parts(StereoLayout::Pair);
  parts.provider = provider.value().get();
  ShowStages stages(std::move(parts));
  const std::size_t walls = player->walls().names().size();
  std::vector<DrawList> lists(2 * walls);
  Allocations asked;
  for (std::size_t wall = 0; wall < walls; ++wall) EXPECT_FALSE(stages.openWall(wall));
  for (std::uint64_t frame = 0; frame < kWarm + kDrawnFrames; ++frame) {
    stages.app(signatureAt(frame, 60), frame % kSlots);
    for (std::size_t wall = 0; wall < walls; ++wall) {
      DrawList& list = lists[2 * wall + frame % 2];
      stages.cull(wall, frame % kSlots, list);
      const Allocations before = allocationsSoFar();
      EXPECT_FALSE(stages.draw(wall, list));
      if (frame >= kWarm) asked += allocationsSoFar() - before;
    }
    EXPECT_FALSE(stages.swap(signatureAt(frame, 60)));
  }
  for (std::size_t wall = 0; wall < walls; ++wall) stages.closeWall(wall);
  return asked.count;
}

std::string showOf(const TestFolder& folder, const std::string& text) {
  return folder.write("show.evs", text);
}

constexpr const char* kStill =
    "pose head 0 0 -3 1.7 1 0 0 0\npose foot 0 0 -2 0.2 1 0 0 0\npose wand 0 0.3 -2 1.2 1 0 0 0\n";

class ProgramSteadyState : public ::testing::Test {
protected:
  void SetUp() override {
    if (!countsAllocations()) GTEST_SKIP() << "this build does not count";
  }
  TestFolder folder_;
};

TEST_F(ProgramSteadyState, OfWhatStandsStill) {
  std::string text;
  for (int i = 0; i < 500; ++i)
    text += fmt::format("object( file=football.3ds, position=\"{}, 9, 0\" )\n", i);
  EXPECT_EQ(allocationsOfApp(showOf(folder_, text)), 0u);
}

TEST_F(ProgramSteadyState, OfWhatPathsAndSwaysMove) {
  std::string text = "rig( name=room )\npath( target=room, loop=on, key=\"0, 0,0,0, 0,0,0\", "
                     "key=\"9, 5,0,0, 0,0,90\", key=\"18, 0,0,0, 0,0,0\" )\n",
              targets;
  for (int i = 0; i < 500; ++i) {
    text += fmt::format("object( name=b{0}, file=football.3ds, position=\"{0}, 9, 0\" )\n", i);
    if (i % 2 == 0)
      targets += fmt::format(", target=b{}", i);
    else
      text += fmt::format("path( target=b{0}, loop=on, smooth=on, key=\"0, {0},0,1\", key=\"9, {0},5,1\", "
                          "key=\"18, {0},0,1, 0,0,90\" )\n",
                          i);
  }
  text +=
      fmt::format("sway( amplitude=\"1, 0, 1\", phasestep=10, angularvelocity=\"0, 0, 5\"{} )\n", targets);
  EXPECT_EQ(allocationsOfApp(showOf(folder_, text), kStill), 0u);
}

TEST_F(ProgramSteadyState, DrawOfThingsOfEveryKindInBothLooks) {
  std::string text = "light( direction=\"-1, 2, -3\" )\n"
                     "text( text=\"olympia\", position=\"0, 5, 1\" )\nrig( name=room )\n"
                     "path( target=room, loop=on, key=\"0, 0,0,0, 0,0,0\", key=\"0.2, 0,1,0, 0,0,20\", "
                     "key=\"0.4, 0,0,0, 0,0,0\" )\n";
  for (int i = 0; i < 40; ++i)
    text += fmt::format("object( file={}, position=\"{}, {}, {}\" )\n", i % 3 ? "football.3ds" : "plane.3ds",
                        i % 20 - 10, 3 + i / 20, i % 3);
  const std::string lamps = "light( type=point, position=\"0, 4, 3\", range=9 )\n";
  for (const Look look : {Look::Full, Look::Plain}) {
    EXPECT_EQ(allocationsOfDraw(showOf(folder_, text), look), 0u) << nameOf(look);
    EXPECT_EQ(allocationsOfDraw(showOf(folder_, text + lamps), look), 0u) << nameOf(look) << ", lamps";
  }
}

TEST_F(ProgramSteadyState, OfThePapersShowWhileNoFootKicks) {
  EXPECT_EQ(allocationsOfApp(std::string(STADION_SOURCE_DIR) + "/scripts/kick.evs", kStill, 400), 0u);
}

TEST_F(ProgramSteadyState, OfTriggersLevelsLightsAndWhatFollowsADevice) {
  const std::string text =
      "object( name=bat, file=crude_foot.obj )\n"
      "timer( period=0.1, eventmessage=\"timesup, bat, attach all wand\" )\n"
      "usertrigger( sphere=\"0, 0, 0, 1\", eventmessage=\"enter, bat, hide\" )\n"
      "wandtrigger( box=\"0, 0, 0, 1, 1, 1\", eventmessage=\"enter, bat, hide\" )\n"
      "lod( name=statue, ranges=\"15, 60\", position=\"0, 30, 0\" )\n"
      "object( parent=statue, file=football.3ds )\nobject( parent=statue, file=football.3ds, scale=2 )\n"
      "path( name=lift, loop=on, key=\"0, 0,0,0\", key=\"9, 0,0,3\", key=\"18, 0,0,0\" )\n"
      "light( type=point, parent=lift, position=\"0, 4, 3\", colour=\"1, 0.8, 0.6\" )\n";
  EXPECT_EQ(allocationsOfApp(showOf(folder_, text), kStill), 0u);
}

}  // namespace
}  // namespace stadion
