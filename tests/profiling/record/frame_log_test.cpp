/// What a frame log records: spans of several threads, with their nodes, counts and samples.

#include "profiling/record/frame_log.h"
#include "profiling/report/show_profile.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <map>
#include <memory>
#include <set>
#include <thread>
#include <vector>

namespace stadion {
namespace {

constexpr NodeRef kBallNode{1, 0}, kStoneNode{1, 1};

void burn(std::chrono::microseconds time) {
  const auto end = ProfileClock::now() + time;
  while (ProfileClock::now() < end) {
  }
}

TEST(ThreadsFrameLog, SpansOfManyThreadsArriveWholeAndNested) {
  struct Kept final : SpanReader {
    std::map<std::size_t, std::vector<SpanRecord>> tracks;
    using SpanReader::take;
    void take(std::size_t track, const SpanRecord& r) override { tracks[track].push_back(r); }
  } kept;
  FrameLog log({&kept}, {.samples = false, .from = 0});
  constexpr std::uint64_t kFrames = 2000;
  std::vector<std::thread> walls;
  for (std::uint32_t wall = 0; wall < 4; ++wall)
    walls.emplace_back([&log, wall] {
      for (std::uint64_t frame = 0; frame < kFrames; ++frame) {
        const SpanScope stage(&log, Span::Cull, frame, wall);
        const SpanScope part(&log, Span::Test);
      }
    });
  for (std::thread& t : walls) t.join();
  log.finish();
  EXPECT_EQ(log.lost(), 0U);
  ASSERT_EQ(kept.tracks.size(), 4U);
  for (const auto& [number, spans] : kept.tracks) {
    ASSERT_EQ(spans.size(), 2 * kFrames);
    for (std::size_t i = 0; i < spans.size(); i += 2) {
      EXPECT_EQ(spans[i].what, Span::Test);
      EXPECT_EQ(spans[i + 1].what, Span::Cull);
      EXPECT_EQ(spans[i].frame, i / 2) << "a part knows its stage's frame";
      EXPECT_EQ(spans[i].wall, spans[i + 1].wall);
      EXPECT_GE(spans[i].began, spans[i + 1].began);
      EXPECT_LE(spans[i].ended, spans[i + 1].ended);
    }
  }
}

TEST(ThreadsFrameLog, HoweverMuchHasComeTogetherThreadsAreToldSideBySide) {
  struct Kept final : SpanReader {
    std::vector<SpanRecord> all;
    using SpanReader::take;
    void take(std::size_t, const SpanRecord& r) override { all.push_back(r); }
  } kept;
  constexpr std::uint64_t kFrames = 5000;
  {
    FrameLog log({&kept}, {.samples = false, .from = 0});
    std::atomic<std::uint64_t> published = 0;
    std::thread wall([&] {
      for (std::uint64_t frame = 0; frame < kFrames; ++frame) {
        while (published <= frame) std::this_thread::yield();
        const SpanScope stage(&log, Span::Cull, frame, 0);
      }
    });
    for (std::uint64_t frame = 0; frame < kFrames; ++frame) {
      { const SpanScope stage(&log, Span::App, frame, kNoWall); }
      ++published;
    }
    wall.join();
  }
  std::uint64_t app = 0;
  for (const SpanRecord& r : kept.all)
    if (r.what == Span::App)
      app = r.frame;
    else
      EXPECT_GE(app + 1, r.frame) << "App of a frame is over before its Cull is";
}

TEST(FrameLog, WhatAStageDoesBesideItsPartsIsItsOwn) {
  ShowProfile profile;
  // A frame that lost its processor to others is left out; the next one counts then.
  for (std::uint64_t frame = 0; !profile.nodes().contains(kBallNode) && frame < 100'000; ++frame) {
    profile = ShowProfile();
    FrameLog log({&profile}, {.samples = false, .from = 0});
    {
      const SpanScope app(&log, Span::App, frame, kNoWall);
      burn(std::chrono::microseconds(300));
      const SpanScope node(&log, Span::Simulate, kBallNode);
      burn(std::chrono::microseconds(700));
    }
    log.finish();
  }
  const SpanTotal& app = profile.spans().at({Span::App, kNoWall});
  const double simulated = profile.nodes().at(kBallNode).phases[1];
  EXPECT_GE(simulated, 0.699);
  EXPECT_GE(app.own, 0.3);
  EXPECT_NEAR(app.own + simulated, app.ms.sum(), 1e-3) << "every moment is somebody's, once";
}

TEST(FrameLog, WorkIsCountedOfTheStageEyeOrNodeThatDidIt) {
  ShowProfile profile;
  FrameLog log({&profile}, {.samples = false, .from = 2});
  for (std::uint64_t frame = 0; frame < 4; ++frame) {
    FrameProbe& probe = log;
    const SpanScope stage(&log, Span::Draw, frame, 1);
    probe.counted(Count::Instances, 10 + frame, {});
    const SpanScope eye(&log, Span::RightEye);
    probe.counted(Count::Triangles, 100 * frame, {});
    probe.counted(Count::Contacts, 1, kBallNode);
  }
  log.finish();
  const auto counted = [&](Span of, Count what, NodeRef node = {}) {
    return profile.counts().at({of, 1, node, what});
  };
  EXPECT_EQ(profile.counts().size(), 3U);
  EXPECT_EQ(counted(Span::Draw, Count::Instances).sum(), 12 + 13) << "of frames that are recorded";
  EXPECT_EQ(counted(Span::RightEye, Count::Triangles).sum(), 200 + 300);
  EXPECT_EQ(counted(Span::RightEye, Count::Contacts, kBallNode).count(), 2U);
}

TEST(FrameLog, AReaderMayTakeTheFirstFramesToo) {
  struct Kept : SpanReader {
    std::vector<std::uint64_t> spans, counts;
    using SpanReader::take;
    void take(std::size_t, const SpanRecord& r) override { spans.push_back(r.frame); }
    void take(const CountRecord& c) override { counts.push_back(c.frame); }
  };
  struct KeptAll final : Kept {
    bool takesFirstFrames() const override { return true; }
  };
  Kept later;
  KeptAll all;
  FrameLog log({&later, &all}, {.samples = false, .from = 2});
  for (std::uint64_t frame = 0; frame < 4; ++frame) {
    FrameProbe& probe = log;
    const SpanScope stage(&log, Span::Draw, frame, 1);
    probe.counted(Count::Instances, 10, {});
  }
  log.finish();
  EXPECT_EQ(later.spans, (std::vector<std::uint64_t>{2, 3}));
  EXPECT_EQ(later.counts, later.spans);
  EXPECT_EQ(all.spans, (std::vector<std::uint64_t>{0, 1, 2, 3}));
  EXPECT_EQ(all.counts, all.spans);
}

TEST(FrameLog, TellsWhatAStageAllocates) {
  if (!countsAllocations()) GTEST_SKIP() << "sanitizers allocate themselves";
  struct Kept final : SpanReader {
    std::vector<SpanRecord> spans;
    using SpanReader::take;
    void take(std::size_t, const SpanRecord& r) override { spans.push_back(r); }
  } kept;
  FrameLog log({&kept}, {.samples = false, .from = 0});
  std::vector<std::unique_ptr<char[]>> memory;
  memory.reserve(8);
  {
    const SpanScope app(&log, Span::App, 0, kNoWall);
    memory.push_back(std::make_unique<char[]>(100));
    const SpanScope node(&log, Span::Simulate, kBallNode);
    for (int i = 0; i < 3; ++i) memory.push_back(std::make_unique<char[]>(1000));
  }
  log.finish();
  ASSERT_EQ(kept.spans.size(), 2U);
  EXPECT_EQ(kept.spans[0].allocations.count, 3U);
  EXPECT_EQ(kept.spans[0].allocations.bytes, 3000U);
  EXPECT_EQ(kept.spans[1].allocations.count, 4U) << "the node's are App's too";
}

/// Frames in which so many nodes are visited.
void visitNodes(FrameLog& log, std::uint32_t nodes, std::uint64_t frames, std::uint32_t slow) {
  for (std::uint64_t frame = 0; frame < frames; ++frame) {
    const SpanScope app(&log, Span::App, frame, kNoWall);
    for (std::uint32_t i = 0; i < nodes; ++i) {
      {
        const SpanScope mail(&log, Span::Mail);
        if (i == slow) burn(std::chrono::microseconds(20));
        const SpanScope receive(&log, Span::Receive, NodeRef{1, i});
      }
      {
        const SpanScope simulate(&log, Span::Simulate, NodeRef{1, i});
        if (i == slow) burn(std::chrono::microseconds(400));
      }
      const SpanScope settle(&log, Span::Settle, NodeRef{1, i});
    }
  }
}

TEST(FrameLog, OfVeryManyNodesOnlySomeFramesAreRecordedAsAWhole) {
  ShowProfile profile;
  // A frame that lost its processor to others is left out; the next time fewer may.
  for (int attempt = 0; profile.wholeFrames() < 2 && attempt < 100; ++attempt) {
    profile = ShowProfile();
    FrameLog log({&profile}, {.samples = false, .from = 0});
    visitNodes(log, 1000, 40, 7);
    log.finish();
    EXPECT_EQ(log.lost(), 0U);
    EXPECT_EQ(profile.frames(), 40U) << "stages are timed in every frame";
    EXPECT_LE(profile.wholeFrames(), 6U);
  }
  EXPECT_GE(profile.wholeFrames(), 2U);
  ASSERT_EQ(profile.nodes().size(), 1000U);
  const double each = profile.nodes().at({1, 7}).phases[1] / static_cast<double>(profile.wholeFrames());
  EXPECT_GE(each, 0.399) << "less what recording is thought to take";
}

TEST(FrameLog, ANodeThatTakesLongIsToldInEveryFrame) {
  struct Kept final : SpanReader {
    std::set<std::uint64_t> frames;
    using SpanReader::take;
    void take(std::size_t, const SpanRecord& r) override {
      if (r.node == NodeRef{1, 7} && r.took >= 0.35) frames.insert(r.frame);
    }
  } kept;
  FrameLog log({&kept}, {.samples = false, .from = 0});
  visitNodes(log, 1000, 20, 7);
  log.finish();
  EXPECT_EQ(kept.frames.size(), 20U);
}

TEST(FrameLog, OfNodesThatAreWatchedTheShortVisitsAreAddedUpByAccount) {
  struct Kept final : SpanReader {
    std::map<std::uint64_t, double> visits, others;  ///< by frame [ms]
    using SpanReader::take;
    void take(std::size_t, const SpanRecord& r) override {
      if (r.node.valid() && r.node.position < 100) visits[r.frame] += r.own;
    }
    void take(const ShortVisits& v) override {
      (v.holder == NodeRef{1, 0} ? visits : others)[v.frame] += v.ms;
    }
  } kept;
  FrameLog log({&kept}, {.samples = false, .from = 0});
  const auto accounts = std::make_shared<NodeAccounts>(std::vector{NodeRef{1, 0}, NodeRef{1, 500}});
  for (std::uint32_t i = 0; i < 100; ++i) accounts->add({1, i}, 0);
  for (std::uint32_t i = 500; i < 600; ++i) accounts->add({1, i}, 1);
  log.watch(accounts);
  for (std::uint64_t frame = 0; frame < 40; ++frame) {
    const SpanScope app(&log, Span::App, frame, kNoWall);
    {
      const SpanScope round(&log, Span::Mail);
      burn(std::chrono::microseconds(2500));  // the choice of nodes to visit: of no node
    }
    for (std::uint32_t i = 0; i < 1000; ++i) {
      {
        const SpanScope simulate(&log, Span::Simulate, NodeRef{1, i});
        if (i < 100) burn(std::chrono::microseconds(10));
      }
      const SpanScope settle(&log, Span::Settle, NodeRef{1, i});
    }
  }
  log.finish();
  ASSERT_EQ(kept.visits.size(), 40U) << "in every frame, however it was recorded";
  double least = 1e9;
  for (const auto& [frame, ms] : kept.visits) {
    EXPECT_GE(ms, 0.9) << frame;
    least = std::min(least, ms);
  }
  EXPECT_LT(least, 2.5) << "nothing of what is done for all";
  log.watch(nullptr);
}

TEST(FrameLog, WhatNodesSimulateSideBySideIsEachOnesOwnOnAppsThreadToo) {
  struct Kept final : SpanReader {
    std::set<std::uint64_t> frames;
    using SpanReader::take;
    void take(std::size_t, const SpanRecord& r) override {
      if (r.node == NodeRef{1, 7} && r.took >= 0.35) frames.insert(r.frame);
    }
  } kept;
  FrameLog log({&kept}, {.samples = false, .from = 0});
  for (std::uint64_t frame = 0; frame < 20; ++frame) {
    const SpanScope app(&log, Span::App, frame, kNoWall);
    {
      const SpanScope crew(&log, Span::Workers);
      const SpanScope simulate(&log, Span::Simulate, NodeRef{1, 7});
      burn(std::chrono::microseconds(400));
    }
    for (std::uint32_t i = 0; i < 1000; ++i) const SpanScope settle(&log, Span::Settle, NodeRef{1, i});
  }
  log.finish();
  EXPECT_EQ(kept.frames.size(), 20U);
}

TEST(FrameLog, OfFewNodesEveryFrameIsRecordedAsAWhole) {
  ShowProfile profile;
  // Where others have the processor meanwhile, frames are left out; the next time fewer may.
  for (int attempt = 0; profile.wholeFrames() < 25 && attempt < 100; ++attempt) {
    profile = ShowProfile();
    FrameLog log({&profile}, {.samples = false, .from = 0});
    visitNodes(log, 20, 50, 3);
    log.finish();
  }
  EXPECT_GE(profile.wholeFrames(), 25U);
  EXPECT_GE(profile.nodes().at({1, 3}).settle, static_cast<double>(profile.wholeFrames()) * 0.019)
      << "that it is its turn is the node's";
}

TEST(FrameLog, OnlyWhatIsWatchedIsDrawnAloneUnlessAllIsToBeExplained) {
  const auto accounts = std::make_shared<NodeAccounts>(std::vector{kBallNode});
  accounts->add(kBallNode, 0);
  const std::vector<NodeRef> both{kStoneNode, kBallNode}, other{kStoneNode, {3, 0}};
  FrameLog budgets({}, {.whole = false, .from = 0});
  budgets.watch(accounts);
  EXPECT_TRUE(budgets.wantsAlone(both));
  EXPECT_FALSE(budgets.wantsAlone(other));
  FrameLog profile({}, {.from = 0});
  profile.watch(accounts);
  EXPECT_TRUE(profile.wantsAlone(other));
}

TEST(FrameLog, WhatIsDrawnAloneSaysWhenItsTurnComesAgain) {
  struct Kept final : SpanReader {
    std::vector<IsolatedDrawTime> drawn;
    using SpanReader::take;
    void take(std::size_t, const SpanRecord&) override {}
    void take(const IsolatedDrawTime& d, const std::vector<NodeShare>&) override { drawn.push_back(d); }
  } kept;
  FrameLog log({&kept}, {.from = 0});
  { const SpanScope draw(&log, Span::Draw, 9, 1); }
  EXPECT_EQ(log.nextBatch(1, 0, 801), 0U);
  EXPECT_EQ(log.nextBatch(1, 0, 801), kBatchesAFrame);
  const NodeShare whole{kBallNode, 1};
  log.drewAlone({9, 1, 0, Span::Draw, 1, 0}, {&whole, 1});
  log.finish();
  ASSERT_EQ(kept.drawn.size(), 1U);
  constexpr std::uint64_t kBatches = 801, kTurns = (kBatches + kBatchesAFrame - 1) / kBatchesAFrame;
  EXPECT_EQ(kept.drawn[0].round, kTurns * FrameLogOptions{}.sampleEvery);
}

/// A live run that takes too long draws some of its frames; just then it must be known what is expensive.
TEST(FrameLog, WhereFramesArePassedOverTheNextOneThatIsDrawnIsSampled) {
  FrameLog log({}, {.whole = true, .from = 4});
  std::vector<std::pair<std::uint64_t, DrawSample>> sampled;
  for (std::uint64_t frame = 0; frame < 80; frame += 5)
    if (const DrawSample s = log.drawSample(frame, 0); s != DrawSample::None) sampled.emplace_back(frame, s);
  const std::vector<std::pair<std::uint64_t, DrawSample>> wanted{
      {10, DrawSample::Whole}, {15, DrawSample::Some},  {25, DrawSample::Whole},
      {30, DrawSample::Some},  {40, DrawSample::Whole}, {45, DrawSample::Some},
      {60, DrawSample::Whole}, {65, DrawSample::Some},  {75, DrawSample::Whole}};
  EXPECT_EQ(sampled, wanted);
  EXPECT_EQ(log.drawSample(75, 0), DrawSample::Some);
  EXPECT_EQ(log.drawSample(75, 0), DrawSample::None) << "the operator has paused: the same frame again";

  const NodeRef seen[] = {kBallNode};
  EXPECT_FALSE(log.wantsShares(15, 0));
  EXPECT_TRUE(log.wantsShares(21, 0));
  log.shared(Span::Fill, 21, 0, seen);
  EXPECT_FALSE(log.wantsShares(31, 0));
  EXPECT_TRUE(log.wantsShares(33, 0));
}

TEST(FrameLog, DrawingIsSampledFromWhenSomebodyAsksForIt) {
  FrameLog log({}, {.samples = false, .whole = false, .from = 0});
  EXPECT_EQ(log.drawSample(9, 0), DrawSample::None);
  EXPECT_FALSE(log.wantsShares(16, 0));
  log.setSamples(true);
  EXPECT_EQ(log.drawSample(9, 0), DrawSample::Some);
  EXPECT_EQ(log.drawSample(8, 0), DrawSample::None) << "whole eyes were not asked for";
  EXPECT_TRUE(log.wantsShares(16, 0));
  FrameLog shares({}, {.samples = false, .shares = true, .from = 0});
  EXPECT_TRUE(shares.wantsShares(16, 0));
  EXPECT_EQ(shares.drawSample(9, 0), DrawSample::None);
}

}  // namespace
}  // namespace stadion
