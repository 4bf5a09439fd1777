/// Walls drawn by processes, on ticks of 1/60 s: when one is killed or stopped, the others go on. Judged by
/// the time from swap to swap, with --full: the others never miss more than one frame. A run in which others
/// had the processors says nothing; then another one is watched. Without --full, by what is swapped
/// meanwhile.

#include "tests/proc.h"
#include "tests/programs/program.h"
#include "tests/show/player/played_show.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <csignal>
#include <functional>
#include <gtest/gtest.h>
#include <thread>
#include <unistd.h>

namespace stadion {
namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

constexpr double kRate = 60;  // [1/s]
/// Between swaps, in periods: a wall that misses one frame leaves two, one that misses two leaves three. An
/// undisturbed wall leaves one, and hardly two.
constexpr double kMostPeriods = 2.5, kCalm = 1.8;
constexpr std::uint64_t kGapFrames = 180;  // frames

/// The processes that draw walls for this one.
std::vector<pid_t> wallProcesses() {
  std::vector<pid_t> pids;
  for (const pid_t process : procNumbers()) {
    if (procText(process, "comm") != "stadion-wall\n") continue;
    const std::vector<std::string> stat = procStat(process);
    if (stat.size() > 1 && stat[0] != "Z" && std::stoi(stat[1]) == ::getpid()) pids.push_back(process);
  }
  std::ranges::sort(pids);
  return pids;
}

struct Fault {
  int signal = 0;
  Clock::time_point at{};
};

/// When frames were swapped, and when what befell a process.
struct Watched {
  std::vector<Clock::time_point> swaps;
  std::vector<Fault> faults;
  std::uint64_t inARow = 0;  ///< frames in a row that a wall was late

  /// The longest time from swap to swap within [from, to], in periods.
  double longest(Clock::time_point from, Clock::time_point to) const {
    double most = 0;
    for (std::size_t i = 1; i < swaps.size(); ++i)
      if (swaps[i] >= from && swaps[i - 1] <= to)
        most = std::max(most, kRate * std::chrono::duration<double>(swaps[i] - swaps[i - 1]).count());
    return most;
  }
};

/// What is done to the walls' processes while the show plays, on a thread of its own.
using Fate = std::function<void(const std::atomic<std::size_t>& shown, Watched& watched)>;

/// Plays the show until `fate` is over.
std::optional<Watched> watch(Look look, const std::string& walls, const Fate& fate) {
  const TestFolder folder;
  ShowOptions show;
  show.script = folder.write("show.evs", "object( name=floor, file=plane.3ds )\n"
                                         "object( file=football.3ds, position=\"0, 3, 1\" )\n");
  show.walls = walls, show.size = "64x48", show.look = look, show.input = "none";
  show.assetRoots = {assetFolder()};
  Diagnostics findings;
  const auto player = show.complete(findings) ? Player::create(show, findings) : nullptr;
  printFindings(findings);
  auto provider = openGlProvider(GlProviderKind::OsMesa);
  if (!player || !provider) return {};
  ShowParts parts = player->parts(StereoLayout::Pair);
  parts.provider = provider.value().get();
  parts.wallProcesses.emplace().everyFrame = false;
  Watched watched;
  watched.swaps.reserve(1 << 16);
  std::atomic<std::size_t> shown = 0;
  parts.shown = [&] { watched.swaps.push_back(Clock::now()), ++shown; };
  ShowStages stages(std::move(parts));
  FrameLoopOptions o = player->loopOptions();
  o.frames = 0, o.end = 0, o.rate = kRate, o.pace = Pace::Lock, o.delivery = Delivery::Latest;
  std::atomic<bool> enough = false;
  FrameLoop loop(stages, o, enough);
  std::thread other([&] {
    fate(shown, watched);
    enough = true;
  });
  const FrameLoopOutcome outcome = loop.run();
  other.join();
  EXPECT_FALSE(outcome.failure) << outcome.failure->message;
  for (std::size_t wall = 0; wall < o.walls; ++wall)
    watched.inARow = std::max(watched.inARow, stages.late(wall).inARow);
  return watched;
}

/// Signals to one of them after the other, each for a while after the one before it.
Fate signals(const std::vector<int>& all) {
  return [all](const std::atomic<std::size_t>& shown, Watched& watched) {
    const auto sleepFor = [](int ms) { std::this_thread::sleep_for(milliseconds(ms)); };
    while (shown < 60) sleepFor(20);
    const std::size_t processes = wallProcesses().size();
    for (const int signal : all) {
      sleepFor(3000);
      const std::vector<pid_t> now = wallProcesses();
      if (now.size() != processes) break;
      watched.faults.push_back({signal, Clock::now()});
      ::kill(now[now.size() / 2], signal);
      sleepFor(1000);
    }
    sleepFor(3000);
  };
}

class ProgramFullWallGaps : public ::testing::TestWithParam<Look> {};

TEST_P(ProgramFullWallGaps, TheOtherWallsMissNoMoreThanAFrameWhenOneIsKilledOrStopped) {
  constexpr int kMostRuns = 10;
  for (int run = 0; run < kMostRuns; ++run) {
    const auto watched = watch(GetParam(), "cave4", signals({SIGKILL, SIGSTOP}));
    ASSERT_TRUE(watched) << "the show cannot be played";
    const std::vector<Fault>& faults = watched->faults;
    const bool calm = faults.size() == 2 && std::ranges::all_of(faults, [&](const Fault& f) {
                        return watched->longest(f.at - milliseconds(2000), f.at) < kCalm;
                      });
    if (!calm) continue;
    for (const Fault& f : faults)
      EXPECT_LT(watched->longest(f.at, f.at + milliseconds(3000)), kMostPeriods)
          << "periods, signal " << f.signal;
    EXPECT_GT(watched->inARow, 1u) << "it was hit";
    EXPECT_LT(watched->inARow, kGapFrames);
    return;
  }
  FAIL() << "in none of the runs the processors were ours";
}

INSTANTIATE_TEST_SUITE_P(ProgramFull, ProgramFullWallGaps, ::testing::Values(Look::Full, Look::Plain),
                         [](const auto& look) { return std::string(nameOf(look.param)); });

class ProgramWallGaps : public ::testing::TestWithParam<Look> {};

TEST_P(ProgramWallGaps, TheOtherWallsGoOnWhileOneThatWasKilledOrStoppedIsReplaced) {
  const std::string walls =
      GetParam() == Look::Plain ? "cave4" : STADION_SOURCE_DIR "/scripts/suites/two.walls";
  const std::size_t least = walls == "cave4" ? 4 : 2;
  const auto watched = watch(GetParam(), walls, [least](const std::atomic<std::size_t>& shown, Watched&) {
    const auto waitFor = [](const auto& condition) {
      for (int i = 0; i < 30'000 && !condition(); ++i) std::this_thread::sleep_for(milliseconds(10));
      return condition();
    };
    EXPECT_TRUE(waitFor([&] { return shown > 60; }));
    const std::size_t all = wallProcesses().size();
    EXPECT_GE(all, least) << "one for each wall, or for each eye";
    for (const int signal : {SIGKILL, SIGSTOP}) {
      const std::vector<pid_t> before = wallProcesses();
      if (before.size() != all) return ADD_FAILURE() << before.size() << " processes of " << all;
      const pid_t hit = before[least / 2];
      const std::size_t then = shown;
      ::kill(hit, signal);
      EXPECT_TRUE(waitFor([&] {
        const std::vector<pid_t> now = wallProcesses();
        return now.size() == all && std::ranges::find(now, hit) == now.end();
      })) << signal;
      // A process is replaced within milliseconds, which may be less than a frame.
      EXPECT_TRUE(waitFor([&] { return shown > then; })) << "nothing was swapped, signal " << signal;
      const std::size_t since = shown;
      EXPECT_TRUE(waitFor([&] { return shown > since + 60; })) << signal;
    }
  });
  ASSERT_TRUE(watched) << "the show cannot be played";
  EXPECT_GT(watched->inARow, 0U) << "it was hit";
}

INSTANTIATE_TEST_SUITE_P(Program, ProgramWallGaps, ::testing::Values(Look::Full, Look::Plain),
                         [](const auto& look) { return std::string(nameOf(look.param)); });

}  // namespace
}  // namespace stadion
