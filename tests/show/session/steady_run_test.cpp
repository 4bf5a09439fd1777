/// A whole run, with all its threads and the processes that draw its walls, asks for no memory while nothing
/// comes, goes or happens. What Mesa asks for itself, of C, is not counted.

#include "profiling/record/allocations.h"
#include "tests/programs/counting_library/shared_count.h"
#include "tests/programs/program.h"
#include "tests/show/player/played_show.h"

#include <cstdlib>
#include <fmt/format.h>
#include <gtest/gtest.h>

namespace stadion {
namespace {

/// While it is there, programs that are started count what they ask for together (counting_library/).
class CountedChildren {
public:
  CountedChildren() : count_(folder_.write("count", std::string(sizeof(std::uint64_t), '\0'))) {
    ::setenv("LD_PRELOAD", STADION_BINARY_DIR "/bin/libcounting-library.so", 1);
    ::setenv(kSharedCountVariable, (folder_.path() / "count").c_str(), 1);
  }
  ~CountedChildren() {
    ::unsetenv("LD_PRELOAD");
    ::unsetenv(kSharedCountVariable);
  }
  CountedChildren(const CountedChildren&) = delete;
  CountedChildren& operator=(const CountedChildren&) = delete;

  std::uint64_t soFar() const { return count_.value(); }

private:
  TestFolder folder_;
  SharedCount count_;
};

constexpr const char* kSteadyWalls = STADION_SOURCE_DIR "/scripts/suites/two.walls";

struct Way {
  const char* drawnBy;
  Look look;
  const char* walls;
  bool everyFrame;
};

/// How often it asked, here and in its walls' processes.
struct Asked {
  std::uint64_t warming = 0, warmingWalls = 0;  ///< in frames before those that count
  std::uint64_t here = 0, walls = 0;            ///< in those that count
  bool none() const { return here == 0 && walls == 0; }
};

std::string showOf(const TestFolder& folder, bool lamps) {
  std::string text = "light( direction=\"-1, 2, -3\" )\nrig( name=room )\n"
                     "path( target=room, loop=on, key=\"0, 0,0,0, 0,0,0\", key=\"0.2, 0,1,0, 0,0,20\", "
                     "key=\"0.4, 0,0,0, 0,0,0\" )\n";
  std::string targets;
  for (int i = 0; i < 100; ++i) {
    text += fmt::format("object( name=b{}, file={}, position=\"{}, {}, {}\" )\n", i,
                        i % 3 ? "football.3ds" : "plane.3ds", i % 20 - 10, 3 + i / 20, i % 3);
    if (i % 4 == 0) targets += fmt::format(", target=b{}", i);
  }
  text +=
      fmt::format("sway( amplitude=\"1, 0, 1\", phasestep=10, angularvelocity=\"0, 0, 900\"{} )\n", targets);
  if (lamps) text += "light( type=point, position=\"0, 4, 3\", range=9 )\n";
  return folder.write("show.evs", text);
}

std::optional<Asked> askedIn(const Way& way) {
  constexpr std::uint64_t kWarm = 48, kCounted = 24;
  // Of the newest frames it is chance which are shown, and so when the one with the most in it has been.
  const std::uint64_t most = way.everyFrame ? 1 : 6;  // times kCounted
  const TestFolder folder;
  const CountedChildren children;
  ShowOptions show;
  show.script = showOf(folder, way.look == Look::Full), show.walls = way.walls, show.size = "64x48";
  show.look = way.look, show.input = "none", show.assetRoots = {assetFolder()};
  Diagnostics findings;
  const auto player = show.complete(findings) ? Player::create(show, findings) : nullptr;
  printFindings(findings);
  auto provider = openGlProvider(GlProviderKind::OsMesa);
  if (!player || !provider) return {};
  ShowParts parts = player->parts(StereoLayout::Pair);
  parts.provider = provider.value().get();
  std::atomic<bool> enough = false;
  std::uint64_t shown = 0, begin = 0, beginWalls = 0;
  Asked asked;
  parts.shown = [&] {
    if (enough || ++shown < kWarm || (shown - kWarm) % kCounted != 0) return;
    const std::uint64_t here = allocationsOfAllThreads(), walls = children.soFar();
    (shown == kWarm ? asked.warming : asked.here) = here - begin;
    (shown == kWarm ? asked.warmingWalls : asked.walls) = walls - beginWalls;
    begin = here, beginWalls = walls;
    if (shown > kWarm && (asked.none() || shown == kWarm + most * kCounted)) enough = true;
  };
  if (way.drawnBy == std::string("process")) parts.wallProcesses.emplace().everyFrame = way.everyFrame;
  ShowStages stages(std::move(parts));
  FrameLoopOptions o = player->loopOptions();
  o.frames = 0, o.end = 0;
  o.delivery = way.everyFrame ? Delivery::Every : Delivery::Latest;
  FrameLoop loop(stages, o, enough);
  begin = allocationsOfAllThreads(), beginWalls = children.soFar();
  const FrameLoopOutcome outcome = loop.run();
  EXPECT_FALSE(outcome.failure) << outcome.failure->message;
  EXPECT_GE(shown, kWarm + kCounted);
  return asked;
}

class ProgramSteadyRun : public ::testing::TestWithParam<Way> {};

TEST_P(ProgramSteadyRun, AsksForNoMemory) {
  if (!countsAllocations()) GTEST_SKIP() << "a sanitizer counts its own";
  const auto asked = askedIn(GetParam());
  ASSERT_TRUE(asked) << "the show cannot be played";
  EXPECT_GT(asked->warming, 0u);
  if (GetParam().drawnBy == std::string("process")) {
    EXPECT_GT(asked->warmingWalls, 0u);
  }
  EXPECT_EQ(asked->here, 0u);
  EXPECT_EQ(asked->walls, 0u);
}

std::string nameOf(const ::testing::TestParamInfo<Way>& way) {
  return std::string(way.param.drawnBy) + "_" + nameOf(way.param.look) +
         (way.param.everyFrame ? "" : "_newest");
}

INSTANTIATE_TEST_SUITE_P(Program, ProgramSteadyRun,
                         ::testing::Values(Way{"process", Look::Plain, kSteadyWalls, true},
                                           Way{"thread", Look::Plain, kSteadyWalls, true}),
                         nameOf);
INSTANTIATE_TEST_SUITE_P(ProgramFull, ProgramSteadyRun,
                         ::testing::Values(Way{"process", Look::Plain, "cave4", false},
                                           Way{"thread", Look::Plain, "cave4", true},
                                           Way{"thread", Look::Full, "desktop", true},
                                           Way{"process", Look::Full, "desktop", true},
                                           Way{"process", Look::Full, "desktop", false}),
                         nameOf);

}  // namespace
}  // namespace stadion
