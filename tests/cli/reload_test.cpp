/// A part of the show that is loaded and unloaded again and again leaves no trace: not in memory, not in the
/// time a frame takes, not in the bodies beside it.

#include "tests/cli/played_show.h"
#include "tests/cli/program.h"

#include <algorithm>
#include <fmt/format.h>
#include <fstream>
#include <gtest/gtest.h>
#include <malloc.h>
#include <unistd.h>

namespace stadion {
namespace {

constexpr double kRate = 60, kPeriod = 0.1;  // of the cycles in reload_with.evs

std::uint64_t framesFor(int cycles) {
  return static_cast<std::uint64_t>(kRate * kPeriod * cycles) + 6;
}

std::size_t residentBytes() {
  std::ifstream statm("/proc/self/statm");
  std::size_t total = 0, resident = 0;
  statm >> total >> resident;
  return resident * static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
}

struct Growth {
  std::size_t resident = 0;   ///< [bytes], at the end of the cycle
  std::size_t allocated = 0;  ///< [bytes], likewise
};

/// What a run saw, cycle by cycle and frame by frame.
struct Seen {
  std::vector<Growth> cycles;
  std::vector<double> appMs;
  std::vector<Affine> ball;
  std::vector<std::uint64_t> loaded;
};

Seen playReloading(const std::string& script, std::uint64_t frames, GlProvider* provider, Mode mode) {
  Seen seen;
  const auto player = openShow(testShow(script));
  if (!player) return seen;
  ShowParts parts = player->parts(StereoLayout::Pair);
  parts.provider = provider;
  const ShowStages* running = nullptr;
  parts.observer = [&](const TimeSignature& now, const InputSample&, const Scene& scene) {
    player->collect(running->shownFrame());
    const NodeRef ball = scene.resolve("ball", {1, 0});
    seen.ball.push_back(
        scene.placements().world(dynamic_cast<const PlacedNode&>(*player->scene().find(ball)).placement()));
    for (const EventRecord& e : scene.events())
      if (e.event == Event::Loaded) seen.loaded.push_back(now.frame);
    if (now.frame % static_cast<std::uint64_t>(kRate * kPeriod) == 0) {
      const struct mallinfo2 m = mallinfo2();
      seen.cycles.push_back({residentBytes(), m.uordblks + m.hblkhd});
    }
  };
  ShowStages stages(std::move(parts));
  running = &stages;
  FrameLoopOptions o;
  o.mode = mode, o.walls = 1, o.frames = frames;
  const std::atomic<bool> never = false;
  FrameLoop loop(stages, o, never);
  const FrameLoopOutcome outcome = loop.run();
  EXPECT_FALSE(outcome.failure) << *outcome.failure;
  EXPECT_EQ(outcome.framesShown, frames);
  seen.appMs = loop.times().app.values();
  return seen;
}

int cycles() {
  return fullRuns() ? 1000 : 100;
}

TEST(ProgramReload, LoadingAgainAndAgainDoesNotGrow) {
  auto provider = openGlProvider(GlProviderKind::OsMesa);
  ASSERT_TRUE(provider);
  const Seen seen =
      playReloading("reload_with.evs", framesFor(cycles()), provider.value().get(), Mode::Sequential);
  ASSERT_GE(seen.loaded.size(), static_cast<std::size_t>(cycles()) - 1);
  const Growth& early = seen.cycles[10];
  const Growth& late = seen.cycles.back();
  const auto grown = [](std::size_t from, std::size_t to) {
    return static_cast<double>(to) - static_cast<double>(from);
  };
  const double each = grown(early.allocated, late.allocated) / static_cast<double>(seen.cycles.size() - 11);
  fmt::print("{} cycles: resident {:+.0f} kB, allocated {:+.0f} kB, {:+.1f} bytes a cycle\n",
             seen.cycles.size(), grown(early.resident, late.resident) / 1024,
             grown(early.allocated, late.allocated) / 1024, each);
  EXPECT_LT(grown(early.resident, late.resident), 1 << 20);
  // The times of the frames are kept, 8 bytes each for seven series, and the notes of this test.
  EXPECT_LT(each, 6 * (7 * 8 + sizeof(Affine)) * 2.2 + 64);
}

TEST(ProgramReload, ABallBesideItFliesTheSameToTheLastBit) {
  const std::uint64_t frames = framesFor(30);
  const Seen with = playReloading("reload_with.evs", frames, nullptr, Mode::Pipelined),
             without = playReloading("reload_without.evs", frames, nullptr, Mode::Pipelined);
  ASSERT_EQ(with.ball.size(), without.ball.size());
  ASSERT_GT(with.loaded.size(), 25u);
  EXPECT_TRUE(without.loaded.empty());
  for (std::size_t n = 0; n < with.ball.size(); ++n)
    ASSERT_EQ(with.ball[n].matrix(), without.ball[n].matrix()) << "frame " << n;
  EXPECT_NE(with.ball.front().matrix(), with.ball.back().matrix()) << "it must have moved";
}

TEST(ProgramReload, NoFrameTakesLongerBecauseOfIt) {
  if (!fullRuns()) GTEST_SKIP() << "measures time; runs with --full";
  // Frames in a row of which one loads something: only the ones that load are compared, and a second try is
  // allowed, because this machine has other things to do.
  double worst = 1e9, median = 1;
  for (int attempt = 0; attempt < 3 && worst > 3 * median; ++attempt) {
    Seen seen = playReloading("reload_with.evs", framesFor(1000), nullptr, Mode::Sequential);
    std::vector<double> loading;
    for (const std::uint64_t frame : seen.loaded) loading.push_back(seen.appMs[frame]);
    std::sort(loading.begin(), loading.end());
    std::sort(seen.appMs.begin(), seen.appMs.end());
    median = seen.appMs[seen.appMs.size() / 2];
    worst = loading[loading.size() * 99 / 100];
    fmt::print("App: median {:.3f} ms, frames that load: median {:.3f}, p99 {:.3f}, longest {:.3f} ms\n",
               median, loading[loading.size() / 2], worst, loading.back());
  }
  EXPECT_LE(worst, 3 * median);
}

}  // namespace
}  // namespace stadion
