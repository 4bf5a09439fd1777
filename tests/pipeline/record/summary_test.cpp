#include "pipeline/record/progress.h"
#include "pipeline/record/run_summary.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <fcntl.h>
#include <limits>
#include <numeric>
#include <poll.h>
#include <stdlib.h>
#include <unistd.h>

namespace stadion {
namespace {

std::vector<double> oneTo(int n) {
  std::vector<double> v(static_cast<std::size_t>(n));
  std::iota(v.rbegin(), v.rend(), 1.0);  // falling, so that sorting is needed
  return v;
}

TEST(Percentile, IsTheNearestRankExactly) {
  EXPECT_EQ(percentile(oneTo(100), 50), 50);
  EXPECT_EQ(percentile(oneTo(100), 95), 95);
  EXPECT_EQ(percentile(oneTo(100), 99), 99);
  EXPECT_EQ(percentile(oneTo(20), 95), 19);
  EXPECT_EQ(percentile(oneTo(10), 99), 10);
  EXPECT_EQ(percentile(oneTo(3), 50), 2);
  EXPECT_EQ(percentile(oneTo(5), 0), 1);
  EXPECT_EQ(percentile(oneTo(5), 100), 5);
  EXPECT_EQ(percentile({7}, 50), 7);
  EXPECT_EQ(percentile({}, 50), 0);
}

TEST(Percentile, OfAnyCountHasAtLeastThatPartBelow) {
  for (int n = 1; n <= 300; ++n)
    for (int p = 1; p <= 100; ++p) ASSERT_EQ(percentile(oneTo(n), p), (n * p + 99) / 100) << n << " " << p;
}

TEST(SampleStatistics, LeavesOutWhatIsNotFinite) {
  const SampleStatistics d = sampleStatisticsOf({3, NAN, 1, INFINITY, 2});
  EXPECT_EQ(d.count, 3u);
  EXPECT_EQ(d.min, 1);
  EXPECT_EQ(d.mean, 2);
  EXPECT_EQ(d.p50, 2);
  EXPECT_EQ(d.max, 3);
}

RunSummary example() {
  RunSummary s;
  s.show = "scripts/kick.evs";
  s.walls = "cave4";
  s.mode = "pipelined";
  s.stereo = "pair";
  s.width = 800;
  s.height = 600;
  s.rate = 60;
  s.frames = s.framesDrawn = 300;
  s.seconds = 5;
  s.elapsedSeconds = 10;
  s.lateFrames = 2;
  s.frameMs = sampleStatisticsOf(oneTo(10));
  s.stages = {{"app", "", sampleStatisticsOf({1, 2}), ""},
              {"draw", "front", sampleStatisticsOf({9}), "cpu clock"}};
  s.latency = {{"front", sampleStatisticsOf({40})}};
  s.lastFrame = 299;
  s.stateHash = 0x12abULL;
  s.imageHashes = {{"front", "left", 0xfedcba9876543210ULL}};
  s.counters["nodes_visited"] = 10;
  s.files = {"out/contact-sheet.png"};
  s.remarks = {"no video"};
  return s;
}

TEST(RunSummary, IsOneLineOfJsonWithEveryFigure) {
  const std::string text = toJson(example());
  EXPECT_EQ(text.find('\n'), std::string::npos);
  const auto j = nlohmann::json::parse(text);
  EXPECT_EQ(j["frames"], 300);
  EXPECT_EQ(j["late_frames"], 2);
  EXPECT_EQ(j["frame_ms"]["p95"], 10);
  EXPECT_EQ(j["stages"][1]["wall"], "front");
  EXPECT_TRUE(j["stages"][0]["wall"].is_null());
  EXPECT_EQ(j["stages"][1]["method"], "cpu clock");
  EXPECT_EQ(j["motion_to_image_ms"]["front"]["p50"], 40);
  EXPECT_EQ(j["state_hash"], "00000000000012ab");
  EXPECT_EQ(j["image_hashes"][0]["hash"], "fedcba9876543210");
  EXPECT_EQ(j["counters"]["nodes_visited"], 10);
}

TEST(RunSummary, MakesGoodJsonOfBadNumbersAndNames) {
  RunSummary s = example();
  s.seconds = NAN;
  s.counters["broken"] = std::numeric_limits<double>::infinity();
  s.show = "bad \xff name\n";
  s.stateHash.reset();
  const auto j = nlohmann::json::parse(toJson(s));
  EXPECT_TRUE(j["seconds"].is_null());
  EXPECT_TRUE(j["counters"]["broken"].is_null());
  EXPECT_TRUE(j["state_hash"].is_null());
}

TEST(RunSummary, TellsOfStressWhetherThereAreBudgetsOrNot) {
  RunSummary s = example();
  EXPECT_FALSE(nlohmann::json::parse(toJson(s)).contains("stress")) << "there was no decider";
  s.stress = StressSummary{};
  EXPECT_EQ(nlohmann::json::parse(toJson(s))["stress"]["highest"], 1);
  EXPECT_EQ(toText(s).find("farther away"), std::string::npos);
  s.stress = StressSummary{4, 2, 12};
  const auto stress = nlohmann::json::parse(toJson(s))["stress"];
  EXPECT_EQ(stress["highest"], 4);
  EXPECT_EQ(stress["at_end"], 2);
  EXPECT_EQ(stress["changes"], 12);
  EXPECT_NE(toText(s).find("everything counted as up to 4 times farther away, 2 at the end, 12 changes"),
            std::string::npos)
      << toText(s);
}

TEST(RunSummary, TellsPeopleTheSame) {
  const std::string text = toText(example());
  for (const char* part :
       {"300 frames", "2 late", "30.0 frames/s", "motion to image", "fedcba9876543210 front left",
        "00000000000012ab", "nodes_visited: 10", "wrote out/contact-sheet.png", "note: no video"})
    EXPECT_NE(text.find(part), std::string::npos) << part << "\n" << text;
}

TEST(Progress, IsALineOfBoundedLength) {
  EXPECT_EQ(progressLine(0, 10, 0), "[                              ] 0/10  0.0 frames/s");
  EXPECT_EQ(progressLine(5, 10, 1), "[###############               ] 5/10  5.0 frames/s  1 s left");
  EXPECT_EQ(progressLine(20, 10, 1).find("[##############################] 10/10"), 0u);
  EXPECT_EQ(progressLine(7, 0, 2), "frame 7  3.5 frames/s");
  EXPECT_LE(progressLine(123456789012, 999999999999, 1e-3, 40).size(), 40u);
}

TEST(Progress, DrawsNothingWhereThereIsNoTerminal) {
  int ends[2];
  ASSERT_EQ(pipe2(ends, O_NONBLOCK), 0);
  {
    ProgressBar bar(10, ends[1]);
    EXPECT_FALSE(bar.shown());
    for (std::uint64_t i = 0; i <= 10; ++i) bar.update(i);
  }
  char c;
  EXPECT_LT(::read(ends[0], &c, 1), 0);
  close(ends[0]), close(ends[1]);
}

TEST(Progress, DrawsOnATerminalAtMostTenTimesASecondAndWipesItselfAway) {
  const int host = posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK);
  if (host < 0 || grantpt(host) != 0 || unlockpt(host) != 0) GTEST_SKIP() << "no pseudo terminals here";
  const int terminal = open(ptsname(host), O_RDWR | O_NOCTTY);
  ASSERT_GE(terminal, 0);
  setenv("TERM", "xterm", 1);
  {
    ProgressBar bar(1000, terminal);
    EXPECT_TRUE(bar.shown());
    for (std::uint64_t i = 0; i < 1000; ++i) bar.update(i);
  }
  // A terminal hands over what was written in pieces of its own choosing.
  std::string text;
  pollfd ready{host, POLLIN, 0};
  while (!text.ends_with("\r\x1b[K") && poll(&ready, 1, 2000) > 0) {
    char piece[4096];
    const ssize_t got = ::read(host, piece, sizeof piece);
    if (got <= 0) break;
    text.append(piece, static_cast<std::size_t>(got));
  }
  const auto bars = std::count(text.begin(), text.end(), '[') - std::count(text.begin(), text.end(), '\x1b');
  EXPECT_GE(bars, 1);
  EXPECT_LE(bars, 3);  // 1000 updates take far less than 0.3 s
  EXPECT_TRUE(text.ends_with("\r\x1b[K"));
  close(terminal), close(host);
}

std::size_t linesIn(const std::string& text) {
  return static_cast<std::size_t>(std::ranges::count(text, '\n'));
}

TEST(Happenings, WhatANodeTellsAgainAndAgainIsCountedWhereItWasFirst) {
  RunSummary s;
  for (int i = 1; i <= 6; ++i) s.events.push_back({i * 1.0, "finished", "wind"});
  for (int i = 1; i <= 5; ++i) s.events.push_back({6.0 + i, "onimpact", "ball"});
  for (int i = 1; i <= 9; ++i) s.events.push_back({20.0 + i, "measured", "tape", i * 10.0});
  s.eventCount = s.events.size();
  const std::string text = eventsText(s);
  EXPECT_EQ(linesIn(text), 2u + 1 + 5 + 9) << text;
  EXPECT_NE(text.find("   1.0000 s  finished   wind  6 times, until 6.0000 s\n"), text.npos) << text;
  EXPECT_NE(text.find("  10.0000 s  onimpact   ball\n"), text.npos) << text;
  EXPECT_NE(text.find("  29.0000 s  measured   tape  90.000 m\n"), text.npos) << text;
  EXPECT_EQ(text.find("more;"), text.npos) << text;
}

TEST(Happenings, NoMoreThanAPageIsToldAndTheRestIsCounted) {
  RunSummary s;
  for (int i = 0; i < 300; ++i) s.events.push_back({i * 0.1, "enter", fmt::format("zone {}", i)});
  for (int i = 0; i < 50; ++i) s.events.push_back({40.0 + i, "finished", "wind"});
  s.eventCount = 1000;
  const std::string text = eventsText(s);
  EXPECT_EQ(linesIn(text), 2u + RunSummary::kEventsInText + 1) << text;
  EXPECT_NE(text.find("... and 800 more; summary.json (--out DIR, or --json) has the first 350 of them"),
            text.npos)
      << text;
}

}  // namespace
}  // namespace stadion
