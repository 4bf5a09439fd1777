/// Where a frame's time goes: spans of several threads, added up by node and stage.

#include "engine/plain_text/csv_field.h"
#include "profiling/report/show_figures.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>

namespace stadion {
namespace {

constexpr NodeRef kBall{1, 0}, kStone{1, 1};
constexpr std::string_view kMesa = "Mesa, llvmpipe";

void burn(std::chrono::microseconds time) {
  const auto end = ProfileClock::now() + time;
  while (ProfileClock::now() < end) {
  }
}

/// Spans made up by hand, as a reader gets them.
SpanRecord record(Span what, std::uint64_t frame, std::uint32_t wall, NodeRef node, double ms) {
  SpanRecord r;
  r.frame = frame, r.wall = wall, r.node = node, r.what = what;
  r.took = r.own = ms;
  r.depth = isStage(what) ? 0 : 1;
  return r;
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
  for (std::uint64_t frame = 0; !profile.nodes().contains(kBall) && frame < 100'000; ++frame) {
    profile = ShowProfile();
    FrameLog log({&profile}, {.samples = false, .from = 0});
    {
      const SpanScope app(&log, Span::App, frame, kNoWall);
      burn(std::chrono::microseconds(300));
      const SpanScope node(&log, Span::Simulate, kBall);
      burn(std::chrono::microseconds(700));
    }
    log.finish();
  }
  const SpanTotal& app = profile.spans().at({Span::App, kNoWall});
  const double simulated = profile.nodes().at(kBall).phases[1];
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
    probe.counted(Count::Contacts, 1, kBall);
  }
  log.finish();
  const auto counted = [&](Span of, Count what, NodeRef node = {}) {
    return profile.counts().at({of, 1, node, what});
  };
  EXPECT_EQ(profile.counts().size(), 3U);
  EXPECT_EQ(counted(Span::Draw, Count::Instances).sum(), 12 + 13) << "of frames that are recorded";
  EXPECT_EQ(counted(Span::RightEye, Count::Triangles).sum(), 200 + 300);
  EXPECT_EQ(counted(Span::RightEye, Count::Contacts, kBall).count(), 2U);
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
    const SpanScope node(&log, Span::Simulate, kBall);
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
      const SpanScope crew(&log, Span::Crew);
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

TEST(ShowProfile, ASpanIsSharedAmongThoseItWasSpentOn) {
  ShowProfile profile;
  profile.take(0, record(Span::App, 8, kNoWall, {}, 1));
  profile.take(0, record(Span::Test, 8, 0, {}, 2));
  profile.take(0, record(Span::Fill, 8, 0, {}, 1));
  profile.take(0, record(Span::Cull, 8, 0, {}, 3));
  profile.take({Span::Test, 8, 0, 2, {kBall, kStone}});
  profile.take({Span::Fill, 8, 0, 1, {kStone}});
  const ShowFigures f = figuresOf(profile, NodeNames(), {"front"}, kMesa);
  ASSERT_EQ(f.nodes.size(), 2U);
  EXPECT_EQ(f.nodes[0].node, kStone);
  EXPECT_DOUBLE_EQ(f.nodes[0].cull, 2);
  EXPECT_DOUBLE_EQ(f.nodes[1].walls[0].cull, 1);
  EXPECT_DOUBLE_EQ(f.cull.covered(), 1);
}

TEST(ShowProfile, TimeOfOtherProgramsOnTheProcessorIsNoNodesTime) {
  ShowProfile profile;
  const auto frame = [&](std::uint64_t number, NodeRef node, double ms, double delayed) {
    SpanRecord app = record(Span::App, number, kNoWall, {}, ms + 1),
               cull = record(Span::Cull, number, 0, {}, ms);
    app.use.delayed = cull.use.delayed = delayed;
    profile.take(0, record(Span::Simulate, number, kNoWall, node, ms));
    profile.take(0, app);
    profile.take(1, record(Span::Test, number, 0, {}, ms));
    profile.take(1, cull);
  };
  frame(1, kBall, 2, 0);
  frame(2, kStone, 50, 48);
  frame(3, kBall, 2, 0.01);
  EXPECT_EQ(profile.frames(), 3U);
  EXPECT_EQ(profile.wholeFrames(), 2U);
  EXPECT_EQ(profile.keptCulls(0), 2U);
  EXPECT_FALSE(profile.nodes().contains(kStone));
  const ShowFigures f = figuresOf(profile, NodeNames(), {"front"}, kMesa);
  EXPECT_DOUBLE_EQ(f.app.measured, 3);
  EXPECT_DOUBLE_EQ(f.app.nodes, 2);
  EXPECT_DOUBLE_EQ(f.cull.measured, 2);
  const auto stage = std::ranges::find(f.stages, "cull front", &StageRow::name);
  ASSERT_NE(stage, f.stages.end());
  EXPECT_DOUBLE_EQ(stage->ms, 18) << "the stage did take that long";
}

TEST(ShowProfile, TheFirstFrameMayBeTheDisturbedOne) {
  ShowProfile profile;
  for (std::uint64_t number = 0; number < 3; ++number) {
    SpanRecord app = record(Span::App, number, kNoWall, {}, number == 0 ? 50 : 1);
    app.use.delayed = number == 0 ? 49 : 0;
    profile.take(0, record(Span::Input, number, kNoWall, {}, number == 0 ? 49.5 : 0.5));
    profile.take(0, app);
  }
  EXPECT_EQ(profile.wholeFrames(), 2U);
  EXPECT_DOUBLE_EQ(figuresOf(profile, NodeNames(), {"front"}, kMesa).nodes.at(0).app, 0.5);
}

TEST(ShowProfile, WhereEveryFrameIsDisturbedHalfOfThemCount) {
  ShowProfile profile;
  for (std::uint64_t number = 0; number < 10; ++number) {
    SpanRecord app = record(Span::App, number, kNoWall, {}, 5);
    app.use.delayed = 4;
    profile.take(0, record(Span::Simulate, number, kNoWall, kBall, 4));
    profile.take(0, app);
  }
  EXPECT_EQ(profile.wholeFrames(), 5U);
}

TEST(ShowProfile, DrawingCountsByHowOftenANodeIsSeen) {
  ShowProfile profile;
  profile.take(0, record(Span::App, 8, kNoWall, {}, 1));
  profile.take({Span::Fill, 8, 0, 1, {kBall, kStone}});
  profile.take({Span::Fill, 16, 0, 1, {kStone}});
  profile.take({8, 0, 1, Span::Draw, 6, 0.1}, {{kBall, 0.5f}, {kStone, 0.5f}});  // on the right eye
  const ShowFigures f = figuresOf(profile, NodeNames(), {"front"}, kMesa);
  ASSERT_EQ(f.nodes.size(), 2U);
  EXPECT_EQ(f.nodes[0].node, kStone);
  EXPECT_DOUBLE_EQ(f.nodes[0].walls[0].draw[1], 3);
  EXPECT_DOUBLE_EQ(f.nodes[1].walls[0].draw[1], 1.5) << "it was seen in half of the frames";
  EXPECT_DOUBLE_EQ(f.nodes[0].walls[0].draw[0], 0);
}

TEST(ShowProfile, WhatOneEyeDoesNotSeeIsMeasuredAndNothing) {
  ShowProfile profile;
  profile.take(0, record(Span::App, 8, kNoWall, {}, 1));
  profile.take({Span::Fill, 8, 0, 1, {kBall, kStone}});
  profile.take({Span::LeftEye, 8, 0, 7, {kBall, kStone}});  // the 7 ms are not theirs
  profile.take({Span::RightEye, 8, 0, 7, {kBall}});
  profile.take({8, 0, 0, Span::Draw, 8, 0.1}, {{kBall, 0.5f}, {kStone, 0.5f}});
  profile.take({8, 0, 1, Span::Draw, 3, 0.1}, {{kBall, 1}});
  profile.take({24, 0, 0, Span::LeftEye, 9, 0.1}, {});
  profile.take({24, 0, 1, Span::RightEye, 4, 0.1}, {});
  const ShowFigures f = figuresOf(profile, NodeNames(), {"front"}, kMesa);
  EXPECT_EQ(f.framesNeeded, 0U) << "no node waits for a turn";
  EXPECT_TRUE(f.nodes[0].drawMeasured && f.nodes[1].drawMeasured);
  EXPECT_EQ(f.nodes[1].node, kStone);
  EXPECT_DOUBLE_EQ(f.nodes[1].walls[0].draw[1], 0);
  EXPECT_DOUBLE_EQ(f.nodes[0].walls[0].draw[1], 4) << "scaled to its eye";
  EXPECT_LT(f.nodes[1].cull, 1);
}

TEST(ShowProfile, WhatDrawingNextToNothingTakesIsNoNodes) {
  ShowProfile profile;
  profile.take(0, record(Span::App, 8, kNoWall, {}, 1));
  profile.take({Span::Fill, 8, 0, 1, {kBall}});
  profile.take({8, 0, 0, Span::Draw, 0.1, 0.1}, {{kBall, 1}});
  profile.take({8, 0, 0, Span::Sky, -0.2, 0.1}, {});
  profile.take({24, 0, 0, Span::LeftEye, 4, 0.1}, {});
  const ShowFigures f = figuresOf(profile, NodeNames(), {"front"}, kMesa);
  EXPECT_DOUBLE_EQ(f.nodes[0].draw, 0.1 * 1.5);
  EXPECT_DOUBLE_EQ(f.alone.named, 0);
}

TEST(ShowProfile, WhatIsDrawnTogetherIsSharedByHowMuchThereIsToDraw) {
  ShowProfile profile;
  profile.take(0, record(Span::App, 8, kNoWall, {}, 1));
  profile.take({Span::Fill, 8, 0, 1, {kBall, kStone}});
  profile.take({8, 0, 0, Span::Draw, 8, 0.1}, {{kBall, 0.75f}, {kStone, 0.25f}});
  const ShowFigures f = figuresOf(profile, NodeNames(), {"front"}, kMesa);
  EXPECT_DOUBLE_EQ(f.nodes[0].walls[0].draw[0], 6);
  EXPECT_DOUBLE_EQ(f.nodes[1].walls[0].draw[0], 2);
}

TEST(ShowProfile, NodesAndPartsAreScaledAlikeToTheEyeDrawnWhole) {
  ShowProfile profile;
  profile.take(0, record(Span::App, 8, kNoWall, {}, 1));
  profile.take({Span::Fill, 8, 0, 1, {kBall, kStone}});
  profile.take({8, 0, 0, Span::Draw, 6, 0.1}, {{kBall, 1}});
  profile.take({8, 0, 0, Span::Draw, 2, 0.1}, {{kStone, 1}});
  profile.take({8, 0, 0, Span::Resolve, 1, 0.1}, {});
  profile.take({24, 0, 0, Span::LeftEye, 11, 0.1}, {});
  const ShowFigures f = figuresOf(profile, NodeNames(), {"front"}, kMesa);
  EXPECT_DOUBLE_EQ(f.nodes[0].draw, 6 * 11.0 / 9);
  EXPECT_DOUBLE_EQ(f.nodes[1].draw, 2 * 11.0 / 9);
  EXPECT_NEAR(f.alone.covered(), 9.0 / 11, 1e-12) << "as it was drawn alone";
  EXPECT_NE(toText(f, 10).find("came to 82 % of the eyes drawn whole"), std::string::npos) << toText(f, 10);
}

TEST(ShowProfile, DrawIsExplainedAsFarAsItsEyesAre) {
  ShowProfile profile;
  profile.take(0, record(Span::App, 8, kNoWall, {}, 1));
  SpanRecord eye = record(Span::LeftEye, 8, 0, {}, 20);
  profile.take(0, record(Span::Upload, 8, 0, {}, 2));
  profile.take(0, eye);
  profile.take(0, record(Span::Draw, 8, 0, {}, 25));
  profile.take({Span::Fill, 8, 0, 1, {kBall, kStone}});
  profile.take({8, 0, 0, Span::Draw, 1, 0.1}, {{kBall, 1}});
  profile.take({8, 0, 0, Span::Resolve, 1, 0.1}, {});
  profile.take({24, 0, 0, Span::LeftEye, 10, 0.1}, {});
  ShowFigures f = figuresOf(profile, NodeNames(), {"front"}, kMesa);
  EXPECT_DOUBLE_EQ(f.draw.measured, 25);
  EXPECT_DOUBLE_EQ(f.draw.nodes, 2) << "a tenth of the eye; the stone had no turn";
  EXPECT_DOUBLE_EQ(f.draw.named, 2 + 2) << "the upload, and a tenth of the eye";

  profile.take({24, 0, 0, Span::Draw, 1, 0.1}, {{kStone, 1}});
  f = figuresOf(profile, NodeNames(), {"front"}, kMesa);
  EXPECT_DOUBLE_EQ(f.draw.nodes, 20 * 0.2 * 1.5) << "scaled half as high again at most";
  EXPECT_DOUBLE_EQ(f.draw.named, 2 + 20 * 0.1 * 1.5);
  EXPECT_DOUBLE_EQ(f.alone.covered(), 0.3);
  const std::string text = toText(f, 10);
  EXPECT_NE(text.find("draw   44.0%   25.0000"), std::string::npos) << text;
  EXPECT_NE(text.find("alone  30.0%   10.0000"), std::string::npos) << text;
}

TEST(ShowProfile, WhatWasNotDrawnHasNoMethodAndNoFigure) {
  ShowProfile profile;
  profile.take(0, record(Span::App, 8, kNoWall, {}, 1));
  profile.take({Span::Fill, 8, 0, 1, {kBall}});
  const ShowFigures f = figuresOf(profile, NodeNames(), {"front"}, "");
  const auto json = nlohmann::json::parse(toJson(f));
  EXPECT_TRUE(json["draw_method"].is_null());
  EXPECT_TRUE(json["frames_needed"].is_null()) << "no number of frames would do";
  EXPECT_EQ(json["explained"][2]["stage"], "draw");
  EXPECT_TRUE(json["explained"][2]["covered"].is_null());
  EXPECT_EQ(toCsv(f).find(",draw,"), std::string::npos) << toCsv(f);
}

TEST(ShowProfile, OneEyesWallHasNoRightEyeInTheTable) {
  ShowProfile profile;
  profile.take(0, record(Span::App, 8, kNoWall, {}, 1));
  profile.take({Span::Fill, 8, 0, 1, {kBall}});
  profile.take({8, 0, 0, Span::Draw, 2, 0.1}, {{kBall, 1}});
  profile.take({24, 0, 0, Span::Draw, 4, 0.1}, {{kBall, 1}});
  profile.take({24, 0, 0, Span::LeftEye, 3, 0.1}, {});
  const ShowFigures f = figuresOf(profile, NodeNames(), {"front"}, kMesa);
  const std::string csv = toCsv(f);
  EXPECT_EQ(csv.find("right"), std::string::npos) << csv;
  EXPECT_NE(csv.find(",draw,,front,left,3,"), std::string::npos) << csv;
  EXPECT_NE(csv.find("LP_NUM_THREADS"), std::string::npos) << csv;
  EXPECT_NE(csv.find(",,,stage,app,,,,1,"), std::string::npos) << csv;
  EXPECT_EQ(f.nodes[0].drawings, 2U);
  EXPECT_NEAR(f.nodes[0].drawingP95, 4, 0.2);
  EXPECT_NEAR(nlohmann::json::parse(toJson(f))["nodes"][0]["drawing_p95_ms"], 4, 0.2);
}

TEST(ShowProfile, WhatWasDrawnIsNotNothingHoweverMuchTheSkyTook) {
  ShowProfile profile;
  profile.take(0, record(Span::App, 8, kNoWall, {}, 1));
  profile.take({Span::Fill, 8, 0, 1, {kBall, kStone}});
  profile.take({8, 0, 0, Span::Draw, 0.5, 0.1}, {{kBall, 1}});
  profile.take({8, 0, 0, Span::Draw, -0.01, 0.1}, {{kStone, 1}});  // the clock cannot tell it from nothing
  profile.take({8, 0, 0, Span::Sky, 9, 0.1}, {});
  profile.take({8, 0, 0, Span::Resolve, 2, 0.1}, {});
  profile.take({24, 0, 0, Span::LeftEye, 10, 0.1}, {});
  const ShowFigures f = figuresOf(profile, NodeNames(), {"front"}, kMesa);
  EXPECT_EQ(f.nodes[0].node, kBall);
  EXPECT_NEAR(f.nodes[0].draw, 0.5 * 10 / 11.5, 1e-12);
  EXPECT_FALSE(f.nodes[1].drawKnown());
  EXPECT_EQ(f.framesNeeded, 0U) << "both had their turn";
  EXPECT_TRUE(nlohmann::json::parse(toJson(f))["nodes"][1]["draw_ms"].is_null());
  EXPECT_NE(toText(f, 10).find("~ 1 nodes: too little"), std::string::npos) << toText(f, 10);
  EXPECT_NE(toText(f, 10).find(" 0.0000       - "), std::string::npos)
      << "a node that is not visited has no p95";
  EXPECT_NEAR(f.alone.covered(), 1.15, 1e-12) << "the sky is drawn once";
}

TEST(ShowProfile, AppIsWhatItTakesWhileNotEveryNodeIsRecorded) {
  ShowProfile profile;
  SpanRecord light = record(Span::App, 9, kNoWall, {}, 3);
  light.whole = false;
  profile.take(0, record(Span::Simulate, 8, kNoWall, kBall, 2));
  profile.take(0, record(Span::App, 8, kNoWall, {}, 4));
  profile.take(0, light);
  const ShowFigures f = figuresOf(profile, NodeNames(), {"front"}, kMesa);
  EXPECT_DOUBLE_EQ(f.app.measured, 3);
  EXPECT_DOUBLE_EQ(f.nodes[0].app, 1.5) << "half of it, as in the frame that was recorded";
}

TEST(ShowProfile, WhatWasNotSampledIsNotNothing) {
  ShowProfile profile;
  profile.take(0, record(Span::App, 8, kNoWall, {}, 1));
  profile.take(0, record(Span::LeftEye, 8, 0, {}, 5));
  profile.take(0, record(Span::Draw, 8, 0, {}, 5));
  profile.take({Span::Test, 8, 0, 1, {kBall, kStone, {1, 2}}});
  profile.take({Span::Fill, 8, 0, 1, {kBall, kStone}});
  profile.take({8, 0, 0, Span::Draw, 3, 0.1}, {{kBall, 1}});  // the stone had no turn, a third is not seen
  const ShowFigures f = figuresOf(profile, NodeNames(), {"front", "floor"}, kMesa);
  std::map<NodeRef, const NodeRow*> rows;
  for (const NodeRow& row : f.nodes) rows[row.node] = &row;
  EXPECT_TRUE(rows.at(kBall)->walls[0].drawMeasured[0]);
  EXPECT_FALSE(rows.at(kStone)->walls[0].drawMeasured[0]);
  EXPECT_TRUE((rows.at({1, 2})->walls[0].drawMeasured[0])) << "what is not seen costs nothing to draw";
  EXPECT_FALSE(rows.at(kBall)->walls[1].cullMeasured) << "that wall was not looked at";
  EXPECT_FALSE(rows.at(kBall)->drawMeasured);
  EXPECT_GT(f.framesNeeded, 1U);

  const auto json = nlohmann::json::parse(toJson(f));
  for (const auto& node : json["nodes"]) {
    EXPECT_EQ(node["draw_complete"], false);
    EXPECT_TRUE(node["walls"][1]["cull_ms"].is_null());
  }
  EXPECT_TRUE(std::ranges::any_of(json["nodes"], [](const auto& n) { return n["draw_ms"] == 3; }));
  EXPECT_TRUE(std::ranges::any_of(json["nodes"], [](const auto& n) { return n["draw_ms"].is_null(); }));
  const std::string text = toText(f, 10), csv = toCsv(f);
  EXPECT_NE(text.find(">3.000"), std::string::npos) << text;
  EXPECT_NE(text.find("3 of 3 nodes had no turn in 1 frames"), std::string::npos) << text;
  EXPECT_NE(csv.find(",draw,,front,left,3,"), std::string::npos) << csv;
  EXPECT_NE(csv.find(",draw,,front,left,,"), std::string::npos) << csv;
  EXPECT_NE(csv.find(",draw,,front,left,0,"), std::string::npos) << csv;
  EXPECT_NE(toText(ShowFigures(), 5).find("no frame was recorded"), std::string::npos);
}

TEST(ShowProfile, AFieldOfItsTableIsQuotedWhereItMustBe) {
  EXPECT_EQ(csvField("stands/north"), "stands/north");
  EXPECT_EQ(csvField("a,b"), "\"a,b\"");
  EXPECT_EQ(csvField("say \"hi\"\n"), "\"say \"\"hi\"\"\n\"");
  ShowProfile profile;
  profile.take(0, record(Span::Simulate, 0, kNoWall, kBall, 0.25));
  profile.take(0, record(Span::App, 0, kNoWall, {}, 1));
  ShowFigures f = figuresOf(profile, NodeNames(), {"front, left"}, kMesa);
  f.nodes[0].name.path = "a,b", f.nodes[0].name.file = "x \"y\".evs";
  const std::string csv = toCsv(f);
  EXPECT_NE(csv.find("\"a,b\",\"x \"\"y\"\".evs\",0,"), std::string::npos) << csv;
  EXPECT_NE(csv.find(",cull,,\"front, left\",,"), std::string::npos) << csv;
}

TEST(ShowProfile, ItsTablesAgree) {
  ShowProfile profile;
  profile.take(0, record(Span::Simulate, 0, kNoWall, kBall, 0.25));
  profile.take(0, record(Span::App, 0, kNoWall, {}, 1));
  const ShowFigures f = figuresOf(profile, NodeNames(), {"front"}, kMesa);
  const auto json = nlohmann::json::parse(toJson(f));
  EXPECT_DOUBLE_EQ(json["nodes"][0]["app_ms"], 0.25);
  EXPECT_DOUBLE_EQ(json["explained"][0]["covered"], 0.25);
  EXPECT_EQ(json["whole_frames"], 1);
  EXPECT_EQ(toText(f, 10).find("App by node"), std::string::npos);
  ShowFigures parted = f;
  parted.frames = 200;
  EXPECT_NE(toText(parted, 10).find("App by node is of 1 of the 200 frames"), std::string::npos);
  EXPECT_NE(toCsv(f).find(",app,,,,0.25,"), std::string::npos) << toCsv(f);
  EXPECT_NE(toText(f, 10).find("0.2500"), std::string::npos) << toText(f, 10);
}

TEST(CostSeries, PercentilesAreExactToABin) {
  CostSeries s;
  for (int i = 1; i <= 1000; ++i) s.add(0.001 * i);
  EXPECT_NEAR(s.mean(), 0.5005, 1e-9);
  EXPECT_NEAR(s.percentile(50) / 0.5, 1, 0.09);
  EXPECT_NEAR(s.percentile(95) / 0.95, 1, 0.09);
  EXPECT_EQ(s.most(), 1);
  EXPECT_EQ(CostSeries().percentile(95), 0);
}

TEST(FrameLog, OnlyWhatIsWatchedIsDrawnAloneUnlessAllIsToBeExplained) {
  const auto accounts = std::make_shared<NodeAccounts>(std::vector{kBall});
  accounts->add(kBall, 0);
  const std::vector<NodeRef> both{kStone, kBall}, other{kStone, {3, 0}};
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
    std::vector<DrawnAlone> drawn;
    using SpanReader::take;
    void take(std::size_t, const SpanRecord&) override {}
    void take(const DrawnAlone& d, const std::vector<NodeShare>&) override { drawn.push_back(d); }
  } kept;
  FrameLog log({&kept}, {.from = 0});
  { const SpanScope draw(&log, Span::Draw, 9, 1); }
  EXPECT_EQ(log.nextBatch(1, 0, 801), 0U);
  EXPECT_EQ(log.nextBatch(1, 0, 801), kBatchesAFrame);
  const NodeShare whole{kBall, 1};
  log.drewAlone({9, 1, 0, Span::Draw, 1, 0}, {&whole, 1});
  log.finish();
  ASSERT_EQ(kept.drawn.size(), 1U);
  EXPECT_EQ(kept.drawn[0].round, 101U * 16);
}

/// A live run that takes too long draws some of its frames; just then it must be known what is dear.
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

  const NodeRef seen[] = {kBall};
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
