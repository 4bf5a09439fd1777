/// The trace of a run: that viewers take it as it is meant.

#include "tests/profiling/trace/trace_checks.h"

#include "profiling/trace/trace_file.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

namespace stadion {
namespace {

using std::chrono::nanoseconds;

class TraceTest : public testing::Test {
protected:
  void SetUp() override {
    file_ = testing::TempDir() + "trace-" + testing::UnitTest::GetInstance()->current_test_info()->name() +
            ".json";
    std::filesystem::remove(file_);
  }
  void TearDown() override { std::filesystem::remove(file_); }

  TraceOptions options() const {
    TraceOptions o;
    o.file = file_, o.show = "a \"show\"", o.walls = {"front", "left"};
    return o;
  }
  std::string written() const {
    std::stringstream text;
    text << std::ifstream(file_).rdbuf();
    return text.str();
  }
  /// A span from `begin` to `end` [ns].
  SpanRecord span(Span what, std::uint64_t frame, std::uint32_t wall, std::uint8_t depth, std::int64_t begin,
                  std::int64_t end, NodeRef node = {}) const {
    SpanRecord r;
    r.what = what, r.frame = frame, r.wall = wall, r.depth = depth, r.node = node;
    r.began = start_ + nanoseconds(begin), r.ended = start_ + nanoseconds(end);
    r.took = 1e-6 * static_cast<double>(end - begin);
    return r;
  }
  /// A frame's way through all stages, as the threads would tell it.
  void addFrame(TraceFile& trace, std::uint64_t frame) const {
    const auto at = static_cast<std::int64_t>(frame * 10'000'003);
    trace.take(0, span(Span::Simulate, frame, kNoWall, 1, at + 101, at + 999, {1, 0}));
    trace.take(0, span(Span::App, frame, kNoWall, 0, at, at + 1'000'000));
    for (std::uint32_t wall = 0; wall < 2; ++wall) {
      trace.take(1 + wall, span(Span::ForFrame, kNoFrame, wall, 0, at, at + 1'000'001));
      trace.take(1 + wall, span(Span::Test, frame, wall, 1, at + 1'000'101, at + 1'000'202));
      trace.take(1 + wall, span(Span::Cull, frame, wall, 0, at + 1'000'101, at + 1'000'333));
      trace.take(3 + wall, span(Span::ForTurn, frame, wall, 1, at + 2'000'000, at + 2'000'000));
      trace.take(3 + wall, span(Span::Draw, frame, wall, 0, at + 2'000'000, at + 8'000'000));
    }
    trace.take(3, span(Span::Swap, frame, kNoWall, 1, at + 8'000'010, at + 8'000'020));
    trace.take(3, span(Span::ForWalls, frame, 0, 0, at + 8'000'001, at + 8'000'044));
  }

  NodeNames names_;
  std::string file_;
  ProfileClock::time_point start_ = ProfileClock::now() + nanoseconds(1'000'000);
};

TEST_F(TraceTest, ItsSlicesNestAndItsArrowsLeadFromAppToCullToDraw) {
  TraceFile trace(options(), names_);
  for (std::uint64_t frame = 4; frame < 24; ++frame) addFrame(trace, frame);
  ASSERT_FALSE(trace.finish());
  const TraceChecks seen(written());
  EXPECT_EQ(seen.complaints(), std::vector<std::string>());
  EXPECT_EQ(seen.flows(), 40U) << "one a frame and wall";
  EXPECT_EQ(seen.threadNames(),
            (std::set<std::string>{"App", "Cull front", "Cull left", "Draw front", "Draw left"}));
  EXPECT_TRUE(seen.names().contains("for frame")) << "a wait belongs to the frame that was waited for";
  EXPECT_EQ(seen.deepest(), 2U);
}

TEST_F(TraceTest, WhatASpanOfOneThreadHoldsStaysInItOnTheViewersGrid) {
  TraceFile trace(options(), names_);
  // Ends and beginnings that share a nanosecond, or lie one apart.
  std::uint64_t seed = 7;
  const auto random = [&](std::int64_t below) {
    seed = seed * 6364136223846793005ULL + 1442695040888963407ULL;
    return static_cast<std::int64_t>((seed >> 33) % static_cast<std::uint64_t>(below));
  };
  std::int64_t at = 3'600'000'000'000;  // an hour on
  for (std::uint64_t frame = 4; frame < 2000; ++frame) {
    const std::int64_t begin = at;
    for (int part = 0; part < 5; ++part) {
      const std::int64_t from = at + random(130), to = from + random(400);
      trace.take(0, span(Span::Receive, frame, kNoWall, 2, from, to, {1, 1}));
      trace.take(0, span(Span::Mail, frame, kNoWall, 1, from, at = to + random(2)));
    }
    trace.take(0, span(Span::App, frame, kNoWall, 0, begin, at));
    at += random(3);
  }
  ASSERT_FALSE(trace.finish());
  const TraceChecks seen(written());
  for (const std::string& c : seen.complaints())
    EXPECT_NE(c.find("flow"), std::string::npos) << c;  // no wall takes these frames
  EXPECT_EQ(seen.slices(), 1996U * 11);
}

TEST_F(TraceTest, ACounterIsWrittenWhenItChanges) {
  TraceOptions some = options();
  some.last = 8;
  TraceFile trace(some, names_);
  for (const auto& [frame, amount] : {std::pair{4, 70}, {5, 70}, {6, 80}, {7, 70}, {9, 90}}) {
    addFrame(trace, static_cast<std::uint64_t>(frame));
    trace.take({Count::Triangles,
                static_cast<std::uint64_t>(amount),
                Span::LeftEye,
                static_cast<std::uint64_t>(frame),
                1,
                {},
                start_ + std::chrono::milliseconds(frame)});
  }
  ASSERT_FALSE(trace.finish());
  const TraceChecks seen(written());
  EXPECT_EQ(seen.complaints(), std::vector<std::string>());
  std::vector<double> told;
  for (const auto& e : seen.json()["traceEvents"])
    if (e["name"] == "triangles, left left") told.push_back(e["args"]["count"]);
  EXPECT_EQ(told, (std::vector<double>{70, 80, 70}));
}

TEST_F(TraceTest, AFrameThatComesAgainHasOneArrow) {
  TraceFile trace(options(), names_);
  addFrame(trace, 4);
  for (int again = 0; again < 3; ++again) {
    start_ += nanoseconds(100'000'000);
    addFrame(trace, 4);
  }
  ASSERT_FALSE(trace.finish());
  const TraceChecks seen(written());
  EXPECT_EQ(seen.complaints(), std::vector<std::string>());
  EXPECT_EQ(seen.flows(), 2U);
}

TEST_F(TraceTest, OnlyTheFramesThatAreAskedForAreInIt) {
  TraceOptions o = options();
  o.first = 10, o.last = 12;
  TraceFile trace(o, names_);
  for (std::uint64_t frame = 4; frame < 24; ++frame) addFrame(trace, frame);
  ASSERT_FALSE(trace.finish());
  const TraceChecks seen(written());
  EXPECT_EQ(seen.complaints(), std::vector<std::string>());
  EXPECT_EQ(seen.frames(), (std::set<std::uint64_t>{10, 11, 12}));
  EXPECT_EQ(trace.leftOut(), "") << "nothing was left out that was asked for";
}

TEST_F(TraceTest, FramesThatNeverCameAreSaidToBeMissing) {
  const auto leftOut = [&](std::uint64_t first, std::uint64_t last, std::uint64_t frames = 20) {
    TraceOptions o = options();
    o.first = first, o.last = last;
    TraceFile trace(o, names_);
    for (std::uint64_t frame = 4; frame < frames; ++frame) addFrame(trace, frame);
    EXPECT_FALSE(trace.finish());
    EXPECT_EQ(TraceChecks(written()).json()["otherData"].value("left out", ""), trace.leftOut());
    return trace.leftOut();
  };
  EXPECT_EQ(leftOut(10, 19), "");
  EXPECT_EQ(leftOut(10, 20), "frame 20: the run ended with frame 19");
  EXPECT_EQ(leftOut(100, 160), "frames 100 to 160: the run ended with frame 19");
  EXPECT_EQ(leftOut(2, 3), "frames 2 to 3: recording began with frame 4");
  EXPECT_EQ(leftOut(3, 30),
            "frame 3: recording began with frame 4; frames 20 to 30: the run ended with frame 19");
  EXPECT_EQ(leftOut(3, 30, 4), "frames 3 to 30: no frame was recorded");
}

TEST_F(TraceTest, BeyondItsSizeItLeavesOutWholeFramesAndSaysSo) {
  TraceOptions o = options();
  o.mostBytes = 20'000;
  TraceFile trace(o, names_);
  for (std::uint64_t frame = 4; frame < 400; ++frame) addFrame(trace, frame);
  ASSERT_FALSE(trace.finish());
  const TraceChecks seen(written());
  EXPECT_EQ(seen.complaints(), std::vector<std::string>()) << "frames that were begun are finished";
  EXPECT_LT(written().size(), 26'000U);
  EXPECT_NE(trace.leftOut().find("on: the trace would be larger than 0.02 MB"), std::string::npos);
  EXPECT_EQ(seen.json()["otherData"]["left out"], trace.leftOut());
}

TEST_F(TraceTest, PartsOfAStageThatWasLostGoWithIt) {
  TraceFile trace(options(), names_);
  trace.take(0, span(Span::Mail, 4, kNoWall, 1, 100, 900));  // its App never came
  addFrame(trace, 5);
  ASSERT_FALSE(trace.finish());
  const TraceChecks seen(written());
  EXPECT_EQ(seen.complaints(), std::vector<std::string>());
  EXPECT_FALSE(seen.names().contains("mail"));
}

TEST_F(TraceTest, WhereItCannotBeWrittenItSaysSo) {
  TraceOptions o = options();
  o.file = "/nowhere/at/all.json";
  TraceFile trace(o, names_);
  EXPECT_TRUE(trace.error());
  addFrame(trace, 4);
  EXPECT_TRUE(trace.finish());
}

TEST(ThreadsTrace, ARecordingOfManyThreadsIsTakenWithoutAComplaint) {
  const std::string file = testing::TempDir() + "trace-threads.json";
  TraceOptions o;
  o.file = file, o.walls = {"one", "two", "three"};
  NodeNames names;
  TraceFile trace(o, names);
  FrameLog log({&trace}, {.samples = false, .from = 0});
  constexpr std::uint64_t kFrames = 300;
  std::atomic<std::uint64_t> published = 0;
  std::array<std::atomic<std::uint64_t>, 3> culled{};
  std::vector<std::thread> threads;
  const auto wait = [](const std::atomic<std::uint64_t>& count, std::uint64_t beyond) {
    while (count <= beyond) std::this_thread::yield();
  };
  threads.emplace_back([&] {
    for (std::uint64_t frame = 0; frame < kFrames; ++frame, ++published) {
      const SpanScope app(&log, Span::App, frame, kNoWall);
      for (std::uint32_t node = 0; node < 20; ++node) const SpanScope cycle(&log, Span::Simulate, {1, node});
    }
  });
  for (std::uint32_t wall = 0; wall < 3; ++wall) {
    threads.emplace_back([&, wall] {
      for (std::uint64_t frame = 0; frame < kFrames; ++frame, ++culled[wall]) {
        {
          const SpanScope waits(&log, Span::ForFrame, kNoFrame, wall);
          wait(published, frame);
        }
        const SpanScope cull(&log, Span::Cull, frame, wall);
        const SpanScope test(&log, Span::Test);
      }
    });
    threads.emplace_back([&, wall] {
      for (std::uint64_t frame = 0; frame < kFrames; ++frame) {
        wait(culled[wall], frame);
        const SpanScope draw(&log, Span::Draw, frame, wall);
        const SpanScope eye(&log, Span::LeftEye);
      }
    });
  }
  for (std::thread& t : threads) t.join();
  log.finish();
  ASSERT_FALSE(trace.finish());
  std::stringstream text;
  text << std::ifstream(file).rdbuf();
  std::filesystem::remove(file);
  const TraceChecks seen(text.str());
  EXPECT_EQ(seen.complaints(), std::vector<std::string>());
  EXPECT_EQ(seen.flows(), kFrames * 3);
}

TEST(TraceChecksThemselves, FindWhatAViewerWouldComplainOf) {
  const auto complaint = [](const std::string& events) {
    const TraceChecks seen(R"({"displayTimeUnit":"ms","traceEvents":[)" + events + "]}");
    return seen.complaints().empty() ? "" : seen.complaints().front();
  };
  const auto slice = [](const char* name, int ts, int dur, int frame = 4) {
    return fmt::format(R"({{"ph":"X","pid":1,"tid":1,"name":"{}","ts":{},"dur":{},"args":{{"frame":{}}}}})",
                       name, ts, dur, frame);
  };
  const auto flow = [](char ph, int ts) {
    return fmt::format(R"({{"ph":"{}","bp":"e","pid":1,"tid":1,"id":1,"ts":{},"name":"frame"}})", ph, ts);
  };
  const std::string thread = R"({"ph":"M","tid":1,"name":"thread_name","args":{"name":"App"}})";
  const std::string good =
      thread + "," + slice("App", 0, 9) + "," + slice("Cull", 10, 9) + "," + slice("Draw", 20, 9);
  const std::string arrows = "," + flow('s', 0) + "," + flow('t', 10) + "," + flow('f', 20);
  EXPECT_EQ(complaint(good + arrows), "");
  EXPECT_NE(complaint(good + "," + slice("mail", 5, 9)).find("overlaps"), std::string::npos);
  EXPECT_NE(complaint(good + "," + slice("mail", 5, -1)).find("negative duration"), std::string::npos);
  EXPECT_NE(complaint(good + "," + slice("mail", -5, 1)).find("negative time"), std::string::npos);
  EXPECT_NE(complaint(good + "," + flow('s', 0) + "," + flow('t', 40)).find("nothing is around"),
            std::string::npos);
  EXPECT_NE(complaint(good + "," + flow('s', 12)).find("in Cull instead of App"), std::string::npos);
  EXPECT_NE(complaint(good + "," + flow('t', 12)).find("has not begun"), std::string::npos);
  EXPECT_NE(complaint(good + arrows + "," + flow('s', 1)).find("begins twice"), std::string::npos);
  EXPECT_NE(complaint(thread + "," + slice("App", 0, 9) + "," + slice("Cull", 10, 9, 5) + "," +
                      slice("Draw", 20, 9) + arrows)
                .find("from frame to frame"),
            std::string::npos);
  EXPECT_NE(complaint(slice("App", 0, 9)).find("no name"), std::string::npos);
  EXPECT_FALSE(TraceChecks("{").complaints().empty());
}

}  // namespace
}  // namespace stadion
