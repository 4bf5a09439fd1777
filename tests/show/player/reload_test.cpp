/// A part of the show that is loaded and unloaded again and again leaves no trace: not in memory, not in the
/// time a frame takes, not in the bodies beside it.

#include "tests/programs/program.h"
#include "tests/show/player/played_show.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <fstream>
#include <gtest/gtest.h>
#include <malloc.h>
#include <unistd.h>

namespace stadion {
namespace {

constexpr double kReloadRate = 60;
constexpr std::uint64_t kFramesPerCycle = 6;  // in reload_with.evs

std::uint64_t framesFor(int cycles) {
  return kFramesPerCycle * static_cast<std::uint64_t>(cycles) + 6;
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

/// What to play, and what to note of it.
struct Playing {
  std::string script;
  std::uint64_t frames;
  GlProvider* provider = nullptr;
  Mode mode = Mode::Sequential;
  Pace pace = Pace::Free;
  bool noteBall = false, noteMemory = false;
};

struct Seen {
  std::vector<Growth> cycles;
  std::vector<double> frameMs;  ///< all stages of a frame; of sequential runs
  std::vector<Affine> ball;
  std::vector<std::uint64_t> changed;  ///< frames in which the part came or went
  std::size_t loaded = 0;
};

Affine placeOf(const std::string& name, Scene& scene) {
  const Node* node = scene.find(scene.tree().resolve(name, {1, 0}));
  return scene.placements().world(dynamic_cast<const PlacedNode&>(*node).placement());
}

std::vector<double> frameTimes(const FrameTimes& t) {
  std::vector<double> ms = t.app.values();
  for (std::size_t n = 0; n < ms.size(); ++n)
    for (std::size_t w = 0; w < t.cull.size(); ++w) ms[n] += t.cull[w].values()[n] + t.draw[w].values()[n];
  return ms;
}

Seen playReloading(const Playing& what) {
  Seen seen;
  const auto player = openShow(what.script);
  if (!player) return seen;
  ShowParts parts = player->parts(StereoLayout::Pair);
  parts.provider = what.provider;
  parts.observer = [&](const TimeSignature& now, const InputSample&, const Scene& scene) {
    if (what.noteBall) seen.ball.push_back(placeOf("ball", player->scene()));
    for (const EventRecord& e : scene.events()) {
      if (e.event != Event("loaded") && e.event != Event("unloaded")) continue;
      seen.changed.push_back(now.frame);
      seen.loaded += e.event == Event("loaded");
    }
    if (what.noteMemory && now.frame % kFramesPerCycle == 0) {
      const struct mallinfo2 m = mallinfo2();
      seen.cycles.push_back({residentBytes(), m.uordblks + m.hblkhd});
    }
  };
  ShowStages stages(std::move(parts));
  FrameLoopOptions o;
  o.mode = what.mode, o.walls = 1, o.frames = what.frames, o.pace = what.pace, o.rate = kReloadRate;
  const std::atomic<bool> never = false;
  FrameLoop loop(stages, o, never);
  const FrameLoopOutcome outcome = loop.run();
  EXPECT_FALSE(outcome.failure) << outcome.failure->message;
  EXPECT_EQ(outcome.framesShown, what.frames);
  if (what.mode == Mode::Sequential) seen.frameMs = frameTimes(loop.times());
  return seen;
}

int cycles() {
  return fullRuns() ? 1000 : 100;
}

TEST(ProgramReload, LoadingAgainAndAgainDoesNotGrow) {
  auto provider = openGlProvider(GlProviderKind::OsMesa);
  ASSERT_TRUE(provider);
  Playing what{testShow("reload_with.evs"), framesFor(cycles()), provider.value().get()};
  what.noteMemory = true;
  const Seen seen = playReloading(what);
  ASSERT_GE(seen.loaded, static_cast<std::size_t>(cycles()) - 1);
  const Growth& early = seen.cycles[10];
  const Growth& late = seen.cycles.back();
  const auto grown = [](std::size_t from, std::size_t to) {
    return static_cast<double>(to) - static_cast<double>(from);
  };
  const double each = grown(early.allocated, late.allocated) / static_cast<double>(seen.cycles.size() - 11);
  fmt::print("{} cycles: resident {:+.0f} kB, allocated {:+.0f} kB, {:+.1f} bytes a cycle\n",
             seen.cycles.size(), grown(early.resident, late.resident) / 1024,
             grown(early.allocated, late.allocated) / 1024, each);
  // The allocator's high-water mark may rise once, by a megabyte or so: loads are made on one thread and
  // taken apart on another. A kilobyte and a half a cycle would be over this limit.
  EXPECT_LT(grown(early.resident, late.resident), 1.5 * (1 << 20));
  // What is kept of each frame are its times, 8 bytes in each of seven series, and this test's own notes.
  EXPECT_LT(each, kFramesPerCycle * 7 * 8 + 64);
}

TEST(ProgramReload, ABallBesideItFliesTheSameToTheLastBit) {
  const std::uint64_t frames = framesFor(30);
  Playing what{testShow("reload_with.evs"), frames};
  what.mode = Mode::Pipelined, what.noteBall = true;
  const Seen with = playReloading(what);
  what.script = testShow("reload_without.evs");
  const Seen without = playReloading(what);
  ASSERT_EQ(with.ball.size(), without.ball.size());
  ASSERT_GT(with.loaded, 25u);
  EXPECT_EQ(without.loaded, 0u);
  for (std::size_t n = 0; n < with.ball.size(); ++n)
    ASSERT_EQ(with.ball[n].matrix(), without.ball[n].matrix()) << "frame " << n;
  EXPECT_NE(with.ball.front().matrix(), with.ball.back().matrix()) << "it must have moved";
}

// In real time, since only there the loader can keep ahead of the show; with a part that has a tenth of a
// second to get ready. Some frames are long because the machine has other things to do: the ones in which the
// part comes or goes may be so no more often than the others.
TEST(ProgramFullReload, NoFrameTakesLongerBecauseOfIt) {
  if (!fullRuns()) GTEST_SKIP() << "measures time; runs with --full";
  auto provider = openGlProvider(GlProviderKind::OsMesa);
  ASSERT_TRUE(provider);
  const TestFolder folder;
  folder.write("part.evs", fileContent(testShow("part.evs")));
  Playing what;
  what.script =
      folder.write("live.evs", fileContent(testShow("reload_without.evs")) +
                                   "timer( period=0.25, repeat=on, eventmessage=\"timesup, part, load\",\n"
                                   "       eventmessage=\"timesup, part, unload, 0.12\" )\n"
                                   "scene( name=part, file=part.evs, initstate=off, ready=0.1 )\n");
  what.frames = 15 * 1000 + 30;
  what.provider = provider.value().get();
  what.pace = Pace::Lock;
  const Seen seen = playReloading(what);
  EXPECT_GE(seen.loaded, 1000u);

  std::vector<double> sorted = seen.frameMs;
  std::sort(sorted.begin(), sorted.end());
  const double median = sorted[sorted.size() / 2];
  const auto isLong = [&](std::uint64_t frame) { return seen.frameMs[frame] > 3 * median; };
  std::vector<bool> changing(seen.frameMs.size());
  for (const std::uint64_t frame : seen.changed) changing[frame] = true;
  std::array<double, 2> count{}, longOnes{}, longest{};
  for (std::size_t n = 1; n < seen.frameMs.size(); ++n) {  // the first one compiles shaders
    const std::size_t kind = changing[n];
    ++count[kind], longOnes[kind] += isLong(n), longest[kind] = std::max(longest[kind], seen.frameMs[n]);
  }
  fmt::print(
      "frame: median {:.2f} ms; longer than three times that: {} of {} frames in which the part came or went "
      "(longest {:.2f} ms), {} of {} others (longest {:.2f} ms)\n",
      median, longOnes[1], count[1], longest[1], longOnes[0], count[0], longest[0]);
  EXPECT_LE(longOnes[1] / count[1], longOnes[0] / count[0] + 0.002);
}

}  // namespace
}  // namespace stadion
