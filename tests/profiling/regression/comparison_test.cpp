/// What is made of the figures of two builds: exactly, by times, by instructions; and what is written of it.

#include "profiling/regression/baseline.h"
#include "profiling/regression/exact_comparison.h"
#include "profiling/regression/page.h"
#include "profiling/regression/reports.h"
#include "profiling/regression/spans/callgrind_record.h"
#include "profiling/regression/spans/instruction_counter.h"
#include "profiling/regression/spans/span_times.h"
#include "profiling/regression/statistics/detection.h"
#include "profiling/regression/statistics/instruction_comparison.h"
#include "profiling/regression/statistics/noise_calibration.h"
#include "profiling/regression/statistics/time_comparison.h"
#include "profiling/regression/suite_progress.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <random>

namespace stadion::regression {
namespace {

constexpr const char* kSummary = R"({"frames": 60, "frames_drawn": 60, "happened_count": 3,
  "state_hash": "00000000000000aa", "history_hash": "00000000000000bb",
  "image_hashes": [{"wall": "front", "eye": "left", "hash": "00000000000000cc"}],
  "counters": {"messages lost": 0.0, "nodes visited per frame": 2.5},
  "drawn": [{"wall": "front", "eye": "left", "frames": 60, "calls": 120, "instances": 180, "triangles": 720}],
  "stages": [{"stage": "app", "wall": null, "ms": {"count": 60, "p50": 0.25}}],
  "remarks": ["drawn by llvmpipe"]})";

TEST(RegressionFacts, AreTheHashesAndCountsOfASummary) {
  const auto facts = factsOf(kSummary);
  ASSERT_TRUE(facts);
  EXPECT_EQ(facts->state.at("history hash"), "00000000000000bb");
  EXPECT_EQ(facts->images.at("image front left"), "00000000000000cc");
  EXPECT_EQ(facts->counts.at("triangles front left"), "720");
  EXPECT_EQ(facts->counts.at("nodes visited per frame"), "2.5");
  EXPECT_EQ(facts->renderer, "llvmpipe");
  for (const char* none :
       {"", "null", "[]", "{}", "{\"frames\": 1, \"drawn\": 7}", "{\"frames\": 1, \"drawn\": [{}]}"})
    EXPECT_FALSE(factsOf(none)) << none;
}

TEST(RegressionFacts, ThatDifferAreNamedWithBothValues) {
  const RunFacts before = *factsOf(kSummary);
  RunFacts now = before;
  now.counts["triangles front left"] = "722";
  now.counts.erase("events of nodes");
  now.counts["instances front right"] = "1";
  const auto checks = compareFacts(now, {&before, "the baseline"}, {});
  ASSERT_EQ(checks.size(), 3u);
  EXPECT_EQ(checks[0].outcome, Outcome::Passed);
  EXPECT_EQ(checks[1].outcome, Outcome::Passed);
  EXPECT_EQ(checks[2].outcome, Outcome::Failed);
  EXPECT_NE(checks[2].said.find("triangles front left: 722, was 720"), std::string::npos) << checks[2].said;
  EXPECT_NE(checks[2].said.find("events of nodes: missing, was 3"), std::string::npos) << checks[2].said;
  EXPECT_NE(checks[2].said.find("instances front right: 1, was not there"), std::string::npos)
      << checks[2].said;
}

TEST(RegressionFacts, ImagesOfAnotherRendererAreNotCompared) {
  const RunFacts before = *factsOf(kSummary);
  RunFacts now = before;
  now.renderer = "another", now.images["image front left"] = "1";
  Metrics onlyImages{false, true, false, false, false};
  const auto checks = compareFacts(now, {&before, "the baseline"}, onlyImages);
  ASSERT_EQ(checks.size(), 1u);
  EXPECT_EQ(checks[0].outcome, Outcome::Skipped);
}

TEST(RegressionFacts, ThatNeitherTellsAreNotCompared) {
  RunFacts before = *factsOf(kSummary);
  before.state.clear();
  const RunFacts now = before;
  const auto checks = compareFacts(now, {&before, "the other build"}, {});
  ASSERT_EQ(checks.size(), 3u);
  EXPECT_EQ(checks[0].outcome, Outcome::Skipped) << checks[0].said;
  EXPECT_EQ(checks[1].outcome, Outcome::Passed);
}

TEST(RegressionTimes, AStageThatOnlyOneSideHasIsNoPass) {
  const auto checks = unmatchedStages({{"app", 1}, {"draw of wall front", 9}},
                                      {{"app", 1}, {"draw of nowhere", 9}}, "times", "the baseline");
  ASSERT_EQ(checks.size(), 2u);
  EXPECT_EQ(checks[0].metric + ": " + checks[0].said,
            "times of draw of nowhere: the baseline has no such stage");
  EXPECT_EQ(checks[1].metric + ": " + checks[1].said,
            "times of draw of wall front: the baseline has it, this build does not");
  EXPECT_EQ(checks[1].outcome, Outcome::Failed);
}

/// Stages and nodes of a run whose frames are noisy, some of them spoilt.
class MadeRun {
public:
  explicit MadeRun(unsigned seed) : random_(seed) {}

  std::vector<SpanRow> rows(double appFactor, double nodeFactor, double drawFactor) {
    std::vector<SpanRow> all{row("app", "", "", 200 * appFactor + 40 * (nodeFactor - 1)),
                             row("cull", "front", "", 50),
                             row("draw", "front", "", 3000 * drawFactor),
                             row("swap", "", "", 20),
                             row("app", "", "ball", 40 * nodeFactor),
                             row("app", "", "lane", 60)};
    return all;
  }

private:
  SpanRow row(const std::string& stage, const std::string& wall, const std::string& node, double us) {
    SpanRow r;
    r.stage = stage, r.wall = wall, r.path = node, r.line = node.empty() ? 0 : 7;
    r.file = node.empty() ? "" : "show.evs";
    std::lognormal_distribution<double> noise(0, 0.04);
    for (std::uint64_t frame = 0; frame < 60; ++frame)
      r.frames[frame] = us * (1 + 0.3 * std::sin(0.3 * static_cast<double>(frame))) * noise(random_) *
                        (random_() % 15 == 0 ? 4 : 1);
    r.count = r.frames.size(), r.msMean = us / 1000;
    return r;
  }
  std::mt19937_64 random_;
};

std::vector<Round> madeRounds(unsigned seed, double nodeFactor, double drawFactor) {
  MadeRun made(seed);
  std::vector<Round> rounds;
  for (int i = 0; i < 10; ++i) rounds.push_back({made.rows(1, 1, 1), made.rows(1, nodeFactor, drawFactor)});
  return rounds;
}

std::vector<std::string> alarms(const std::vector<StageShift>& shifts) {
  std::vector<std::string> all;
  for (const StageShift& s : shifts)
    if (s.slower) all.push_back(s.culprit);
  return all;
}

TEST(RegressionTimes, ANodeThatBecameDearerIsNamedWithItsPlace) {
  // 25 % of a node of 40 us: 5 % of App.
  EXPECT_EQ(alarms(compareRounds(madeRounds(1, 1.25, 1), 0.03)),
            std::vector<std::string>{"ball (show.evs:7) in app"});
}

TEST(RegressionTimes, AStageThatBecameDearerIsNamedWithItsWall) {
  EXPECT_EQ(alarms(compareRounds(madeRounds(2, 1, 1.05), 0.03)),
            std::vector<std::string>{"draw of wall front"});
}

TEST(RegressionTimes, WhatIsTheSameRaisesNoAlarm) {
  int alarmed = 0;
  for (unsigned seed = 10; seed < 60; ++seed)
    alarmed += !alarms(compareRounds(madeRounds(seed, 1, 1), 0.01)).empty();
  EXPECT_LE(alarmed, 2);
}

TEST(RegressionTimes, WithinTheToleranceIsNoAlarmAndFasterIsNoFailure) {
  EXPECT_TRUE(alarms(compareRounds(madeRounds(3, 1, 1.05), 0.10)).empty());
  const auto shifts = compareRounds(madeRounds(4, 1, 0.8), 0.03);
  EXPECT_TRUE(alarms(shifts).empty());
  EXPECT_TRUE(std::ranges::any_of(shifts, &StageShift::faster));
}

TEST(RegressionTimes, AShiftThatNoNodeExplainsIsReportedAsUnexplained) {
  SpanRow small;
  small.path = "ball", small.stage = "app";
  EXPECT_EQ(culpritIn("app", {}, 10), "app");
  EXPECT_NE(culpritIn("app", {{small, 2.0}}, 10).find("no single node"), std::string::npos);
  EXPECT_EQ(culpritIn("app", {{small, 9.0}}, 10), "ball in app");
}

TEST(RegressionTimes, AStageTooShortForTheClockIsNotJudged) {
  std::vector<Round> rounds = madeRounds(5, 1, 1);
  for (Round& r : rounds)
    for (auto* rows : {&r.before, &r.now})
      for (SpanRow& row : *rows)
        for (auto& [frame, us] : row.frames) us *= (rows == &r.now ? 2e-3 : 1e-3);
  const auto checks = checksOf(compareRounds(rounds, 0.03), "the other build", 0.03, 10);
  ASSERT_EQ(checks.size(), 3u);
  EXPECT_EQ(checks[0].outcome, Outcome::Skipped) << checks[0].said;
  EXPECT_EQ(checks[1].outcome, Outcome::Skipped) << checks[1].said;
}

TEST(RegressionTimes, OfABaselineAreComparedInMultiplesOfTheKernel) {
  const StageTimesByName baseline{{"app", {1, 1.1, 0.9, 1, 1.05, 0.95, 1.02, 0.98}}};
  StageTimesByName now{{"app", {1.3, 1.2, 1.25, 1.28, 1.3, 1.31, 1.22, 1.27}}};
  const auto slower = compareTimes(baseline, now, {{"app", 100}}, 0.05);
  ASSERT_EQ(slower.size(), 1u);
  EXPECT_TRUE(slower[0].slower);
  EXPECT_NEAR(slower[0].shift, 0.27, 0.03);
  EXPECT_FALSE(compareTimes(baseline, baseline, {{"app", 100}}, 0.05)[0].slower);
  EXPECT_GT(calibrationMs(), 0.1);
}

TEST(RegressionTimes, ThatCannotBeComparedAreNoPass) {
  const std::vector<double> twelve{1, 1.1, 0.9, 1, 1.05, 0.95, 1.02, 0.98, 1, 1, 1.01, 0.99};
  const StageTimesByName baseline{{"app", {0, 0, 0}}, {"cull", {}}, {"draw", {1}}, {"sky", twelve}};
  const StageTimesByName now{{"app", twelve}, {"cull", twelve}, {"draw", twelve}, {"sky", twelve}};
  const std::map<std::string, double> us{{"app", 100}, {"cull", 100}, {"draw", 100}, {"sky", 100}};
  const auto checks = checksOf(compareTimes(baseline, now, us, 0.05), "the baseline", 0.05, 12);
  ASSERT_EQ(checks.size(), 4u);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(checks[i].outcome, Outcome::Failed) << checks[i].said;
  EXPECT_EQ(checks[0].said,
            "the baseline's times of it cannot be compared with: the middle one is 0; --update "
            "measures new ones");
  EXPECT_NE(checks[1].said.find("there are none"), std::string::npos) << checks[1].said;
  EXPECT_NE(checks[2].said.find("1 and 12 rounds are too few"), std::string::npos) << checks[2].said;
  EXPECT_EQ(checks[3].outcome, Outcome::Passed) << checks[3].said;
}

TEST(RegressionTimes, OfTooFewRoundsForSoManyStagesAreNoPass) {
  std::vector<Round> rounds = madeRounds(8, 1, 1);
  rounds.resize(5);
  const auto checks = checksOf(compareRounds(rounds, 0.03), "the other build", 0.03, 5);
  ASSERT_EQ(checks.size(), 3u);
  EXPECT_EQ(checks[0].outcome, Outcome::Failed);
  EXPECT_EQ(checks[0].said, "5 rounds are too few to tell anything of 3 stages; --rounds takes more");
}

TEST(RegressionTimes, OfOldBuildsAreThoseOfTheirSummaries) {
  const auto rows = stagesOfSummary(kSummary);
  ASSERT_EQ(rows.size(), 1u);
  EXPECT_EQ(rows[0].name(), "app");
  EXPECT_EQ(rows[0].msMean, 0.25);
  EXPECT_TRUE(stagesOfSummary("nonsense").empty());
}

TEST(RegressionSpans, AreReadBackAsTheyWereWritten) {
  MadeRun made(6);
  const auto rows = made.rows(1, 1, 1);
  const auto again = spanRows(toJson(rows));
  ASSERT_EQ(again.size(), rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    EXPECT_EQ(again[i].key(), rows[i].key());
    EXPECT_EQ(again[i].frames, rows[i].frames);
    EXPECT_EQ(again[i].count, rows[i].count);
  }
  EXPECT_EQ(spanRows("{\"nodes\": " + toJson(rows) + "}").size(), rows.size());
  for (const char* none : {"", "{", "7", "{\"rows\": 3}", "[1, null, \"x\"]"})
    EXPECT_TRUE(spanRows(none).empty());
}

TEST(RegressionSpans, OfAProfileHaveNodesByStageWallAndEye) {
  const auto rows = profileRows(R"({"frames": 9, "walls": ["front"],
    "nodes": [{"path": "ball", "file": "show.evs", "line": 7, "app_ms": 0.5,
               "walls": [{"wall": "front", "cull_ms": 0.25, "draw_left_ms": 1.5, "draw_right_ms": 2}]}],
    "stages": [{"stage": "app", "part": "", "ms": 3}, {"stage": "cull front", "part": "", "ms": 4},
               {"stage": "cull front", "part": "sort", "ms": 1}]})");
  ASSERT_EQ(rows.size(), 6u);
  EXPECT_EQ(rows[1].name(), "ball (show.evs:7) in cull of wall front");
  EXPECT_EQ(rows[3].eye, "right");
  EXPECT_EQ(rows[3].msMean, 2);
  EXPECT_EQ(rows[5].name(), "cull of wall front");
  EXPECT_TRUE(rows[5].isStage());
  for (const char* none : {"", "[]", "{}", "{\"nodes\": 3, \"stages\": [7]}"})
    EXPECT_LE(profileRows(none).size(), 1u);
}

constexpr const char* kCallgrind = R"(# callgrind format
version: 1
cmd:  /usr/bin/stadion run show.evs
part: 1
desc: Trigger: Client Request: row 0
events: Ir
ob=(1) /usr/bin/stadion
fl=(1) a.cpp
fn=(1) stadion::f()
10 100
+2 20
cob=(2) /lib/libOSMesa.so
cfi=(2) b.c
cfn=(2) g
calls=3 50
12 5000
ob=(2)
fl=(2)
fn=(2)
50 5000

part: 2
desc: Trigger: Client Request: row 1
ob=(1)
fn=(1)
10 7
* 3
part: 3
desc: Trigger: Program termination
ob=(1)
fn=(1)
10 999
)";

TEST(RegressionInstructions, OfOurOwnProgramAreSummedByLabelWithoutWhatIsCalled) {
  const auto counts = instructionsByLabel(kCallgrind, "/usr/bin/stadion");
  EXPECT_EQ(counts, (std::map<std::string, double>{{"row 0", 120}, {"row 1", 10}}));
  EXPECT_TRUE(instructionsByLabel(kCallgrind, "/bin/stadion").empty()) << "the whole path counts";
  EXPECT_TRUE(instructionsByLabel("", "/usr/bin/stadion").empty());
  EXPECT_EQ(commandOf(kCallgrind), "/usr/bin/stadion run show.evs");
  EXPECT_EQ(commandOf(""), "");
}

TEST(RegressionInstructions, AStageHasThoseOfItsNodesAndTheOneThatGrewIsNamed) {
  MadeRun made(7);
  std::vector<SpanRow> before = made.rows(1, 1, 1), now = before;
  giveInstructions(before, {{"row 0", 1160000}, {"row 4", 580000}, {"row 5", 1160000}});
  giveInstructions(now, {{"row 0", 1160000}, {"row 4", 696000}, {"row 5", 1160000}});
  EXPECT_DOUBLE_EQ(before[0].instructions, 2900000.0 / 58) << "the first two frames are not counted";
  const auto shifts = compareInstructions(instructionCounts(before), now, 0.005);
  ASSERT_EQ(shifts.size(), 1u);
  EXPECT_TRUE(shifts[0].more);
  EXPECT_NEAR(shifts[0].shift(), 0.04, 1e-9);
  EXPECT_EQ(shifts[0].culprit, "ball (show.evs:7) in app");
  EXPECT_FALSE(compareInstructions(instructionCounts(before), now, 0.05)[0].more);
  EXPECT_TRUE(compareInstructions(instructionCounts(now), before, 0.005)[0].fewer);
}

TEST(RegressionInstructions, WhereThereWereNoneAreNoPass) {
  SpanRow app;
  app.stage = "app", app.instructions = 1e6;
  const auto checks = checksOf(compareInstructions({{{"app", 0}}, {}}, {app}, 0.01), "the baseline", 0.01);
  ASSERT_EQ(checks.size(), 1u);
  EXPECT_EQ(checks[0].outcome, Outcome::Failed) << checks[0].said;
}

TEST(RegressionInstructions, ABaselineKeepsEnoughToNameTheNodeThatMoved) {
  MadeRun made(7);
  std::vector<SpanRow> before = made.rows(1, 1, 1), now = before;
  giveInstructions(before, {{"row 0", 1160000}, {"row 4", 580000}, {"row 5", 1160000}});
  giveInstructions(now, {{"row 0", 1160000}, {"row 4", 696000}, {"row 5", 1160000}});
  for (SpanRow& r : now)
    if (!r.isStage()) r.file = "/somewhere/else/" + r.file;
  BaselineCase kept;
  kept.instructions = stageInstructions(before);
  kept.nodeInstructions = noticeableNodes(nodeInstructions(before), kept.instructions);
  const std::string file = testing::TempDir() + "made.baseline.json";
  std::ofstream(file) << toJson({{"made/sequential", kept}});
  const auto read = readBaseline(file);
  ASSERT_TRUE(read) << read.error().message;
  const BaselineCase& of = read.value().at("made/sequential");
  const auto shifts = compareInstructions({of.instructions, of.nodeInstructions}, now, 0.005);
  ASSERT_EQ(shifts.size(), 1u);
  EXPECT_EQ(shifts[0].culprit, "ball (/somewhere/else/show.evs:7) in app");
  EXPECT_EQ(compareInstructions({of.instructions, {}}, now, 0.005)[0].culprit, "app")
      << "of an older baseline the stage is known";
}

TEST(RegressionInstructions, TheProcessorsCounterGivesEachNodeItsOwnFromTheThirdFrameOn) {
  std::uint64_t executed = 0;
  SpanTimesOptions options;
  options.countInstructions = true;
  options.instructions = [&] { return executed; };
  SpanTimes times(std::move(options));
  for (std::uint64_t frame = 0; frame < 12; ++frame) {
    times.began(Span::App, frame, kNoWall);
    executed += 1000;
    times.began(Span::Simulate, NodeRef{1, 4});
    executed += 50'000;
    times.ended(Span::Simulate);
    executed += 200;
    times.ended(Span::App);
    executed += 7777;  // between the stages
    times.began(Span::Cull, frame, 0);
    executed += 30'000;
    times.ended(Span::Cull);
  }
  const auto rows = times.rows({"front"}, [](NodeRef, SpanRow& row) { row.path = "ball", row.line = 7; });
  const auto counts = instructionCounts(spanRows(toJson(rows)));
  EXPECT_EQ(counts.stages, (std::map<std::string, double>{{"app", 51'200}, {"cull of wall front", 30'000}}));
  EXPECT_EQ(counts.nodes.at("app").at("ball"), 50'000);
}

TEST(RegressionInstructions, AMachineWithoutHardwareCountersReportsWhy) {
  EXPECT_NE(whyNotByHardware(ENOENT).find("no hardware counters"), std::string::npos);
  EXPECT_NE(whyNotByHardware(EACCES).find("perf_event_paranoid"), std::string::npos);
  std::string why;
  const auto counter = InstructionCounter::open(why);
  EXPECT_EQ(counter.has_value(), why.empty());
  if (!counter) return;
  const std::uint64_t before = counter->now();
  burn(100'000);
  EXPECT_GT(counter->now(), before + 100'000);
}

TEST(RegressionInstructions, ABaselineNamesTheirCounter) {
  BaselineCase kept;
  kept.instructions["app"] = 1, kept.countedBy = "hardware counters";
  const std::string file = testing::TempDir() + "counted.baseline.json";
  std::ofstream(file) << toJson({{"made/sequential", kept}});
  EXPECT_EQ(readBaseline(file).value().at("made/sequential").countedBy, "hardware counters");
}

SuiteResult madeResult() {
  SuiteResult result{"a&b.suite", "/bin/stadion", "the baseline", "2026-11-22T11:40:00Z", {}};
  CaseResult c;
  c.name = "kick/sequential", c.seconds = 1.5;
  c.checks = {
      {"state", Outcome::Passed, "2 equal"},
      {"counts", Outcome::Failed, "triangles <front>: 7, was \"8\"", "ball in app", {"triangles <front>"}},
      {"times", Outcome::Skipped, "nothing"}};
  c.milliseconds["app"] = {1, 3, 2}, c.elapsedMs["app"] = {2, 6, 4}, c.processorSeconds = 1.25;
  c.facts = {{"state hash", "00000000000000aa"}, {"frames", "60"}};
  result.cases.push_back(c);
  CaseResult lost;
  lost.name = "lost/sequential", lost.fault = "signal 11 ended it";
  result.cases.push_back(lost);
  return result;
}

TEST(RegressionReports, ForMachinesHaveEveryCheckAndAreWellFormed) {
  const auto j = nlohmann::json::parse(benchmarkJsonOf(madeResult()));
  EXPECT_EQ(j["checks"].size(), 4u);
  const auto median = std::ranges::find_if(
      j["benchmarks"], [](const auto& b) { return b["name"] == "kick/sequential/app_median"; });
  ASSERT_NE(median, j["benchmarks"].end());
  EXPECT_EQ((*median)["real_time"], 4);
  EXPECT_EQ((*median)["cpu_time"], 2);
  EXPECT_EQ(j["benchmarks"][0]["real_time"], 1500);
  EXPECT_EQ(j["benchmarks"][0]["cpu_time"], 1250);
  EXPECT_EQ((*median)["aggregate_name"], "median");

  const std::string xml = junitOf(madeResult());
  EXPECT_NE(xml.find("tests=\"4\" failures=\"1\" errors=\"1\""), std::string::npos) << xml;
  EXPECT_NE(xml.find("triangles &lt;front&gt;: 7, was &quot;8&quot;; moved: ball in app"), std::string::npos)
      << xml;
  EXPECT_NE(xml.find("a&amp;b.suite"), std::string::npos);
}

TEST(RegressionReports, ForPeopleSayWhatMovedAndHowMuchFailed) {
  const std::string text = tableOf(madeResult());
  EXPECT_NE(text.find("moved: ball in app"), std::string::npos) << text;
  EXPECT_NE(
      text.find("1 comparisons passed, 1 failed, 1 had nothing to compare with; 1 cases could not be played"),
      std::string::npos)
      << text;
  const std::vector<HistoryEntry> history{historyEntryOf(madeResult()), historyEntryOf(madeResult())};
  const std::string page = pageOf(madeResult(), history);
  EXPECT_NE(page.find("<svg"), std::string::npos);
  EXPECT_EQ(page.find("http"), std::string::npos) << "nothing is fetched";
  EXPECT_EQ(page.find("<front>"), std::string::npos) << "text is escaped";
}

/// Of the circles of a page's plots: how many are red, and how far apart the highest and the lowest are.
std::pair<std::size_t, double> circlesOf(const std::string& page) {
  std::size_t red = 0;
  double low = 1e9, high = -1e9;
  for (std::size_t at = 0; (at = page.find("<circle", at)) != page.npos; ++at) {
    const double y = std::stod(page.substr(page.find("cy=\"", at) + 4));
    low = std::min(low, y), high = std::max(high, y);
    red += page.substr(at, page.find('>', at) - at).find("#b3261e") != std::string::npos;
  }
  return {red, high - low};
}

TEST(RegressionReports, PlotsAreFlatWhereNothingMovedAndRedWhereThatFigureFailed) {
  SuiteResult result = madeResult();
  result.cases.pop_back();
  CaseResult& c = result.cases.front();
  c.facts = {{"frames", "60"}};
  std::vector<HistoryEntry> history;
  for (const double ms : {10.0, 10.01, 9.99, 10.0}) {
    c.milliseconds["app"] = {ms};
    history.push_back(historyEntryOf(result));
  }
  const auto [red, height] = circlesOf(pageOf(result, history));
  EXPECT_EQ(red, 0u) << "the case failed, but for triangles";
  EXPECT_LT(height, 5) << "a tenth of a percent is no zigzag";

  c.milliseconds["app"] = {12};
  c.checks =
      checksOf({{"app|||", "app", 10'000, 0.2, 0.01, true, false, "ball in app"}}, "the baseline", 0.03, 12);
  history.push_back(readHistory(toJsonLine(historyEntryOf(result)))[0]);
  const auto [redNow, heightNow] = circlesOf(pageOf(result, history));
  EXPECT_EQ(redNow, 1u);
  EXPECT_GT(heightNow, 60);
}

TEST(RegressionFiles, HistoryAndProgressSurviveAHalfWrittenLine) {
  const std::string line = toJsonLine(historyEntryOf(madeResult()));
  const auto history = readHistory(line + line + line.substr(0, line.size() / 2));
  ASSERT_EQ(history.size(), 2u);
  EXPECT_EQ(history[0].cases.at("kick/sequential").figures.at("app [ms]"), 2);
  EXPECT_TRUE(history[0].cases.at("lost/sequential").failed);

  std::vector<CaseResult> results = madeResult().cases;
  EXPECT_EQ(progressLine("lost", results), "") << "what could not be played is not done";
  results.pop_back();
  const std::string done = progressHeading("1234") + progressLine("kick", results);
  const DoneCases read = readProgress(done + progressLine("throw", results).substr(0, 20), "1234");
  ASSERT_EQ(read.size(), 1u);
  EXPECT_EQ(read.at("kick")[0].checks[1].culprit, "ball in app");
  EXPECT_EQ(read.at("kick")[0].milliseconds.at("app").size(), 3u);
  EXPECT_TRUE(readProgress(done, "4321").empty()) << "another program, or another suite";
}

TEST(RegressionFiles, ABaselineIsNamedAfterItsSuite) {
  EXPECT_EQ(baselineBeside("a/b.suite"), "a/b.baseline.json");
  EXPECT_FALSE(readBaseline("/there/is/none.json"));
}

TEST(RegressionDetection, TrialsComeInTurnsAndEachWallAndNodeHasItsTurn) {
  const auto trials = trialsOf(20, 100);
  EXPECT_EQ(trials.size(), 160u);
  EXPECT_EQ(std::ranges::count(trials, std::string("nothing"), &Trial::kind), 100);
  MadeRun made(8);
  const auto rows = made.rows(1, 1, 1);
  // Instructions, of which App has more for its time than Draw.
  const StagePrices prices{{{"app", 900'000}, {"draw of wall front", 40'000}}, 4};
  const auto first = plantedIn({"simulate", 0}, rows, prices, 0.05),
             second = plantedIn({"simulate", 1}, rows, prices, 0.05);
  ASSERT_TRUE(first && second);
  EXPECT_NE(first->name, second->name);
  EXPECT_EQ(first->iterations, 900'000u * 5 / 100 / 4) << "5 % of what decides";
  EXPECT_EQ(plantedIn({"draw", 3}, rows, prices, 0.05)->iterations, 500u);
  EXPECT_EQ(stageOf(*first), "app");
  EXPECT_FALSE(plantedIn({"nothing", 0}, rows, prices, 0.05));
  EXPECT_TRUE(isNamedBy(*first, first->name + " (show.evs:7) in app"));
  EXPECT_FALSE(isNamedBy(*first, second->name + " (show.evs:7) in app"));
  const auto read = PlantedDelay::parse(toText(*plantedIn({"draw", 3}, rows, prices, 0.05)));
  ASSERT_TRUE(read);
  EXPECT_TRUE(isNamedBy(*read, "draw of wall front"));
  for (const char* wrong :
       {"", "draw", "draw:front", "drew:front=3", "cull:front=x", "cull:=3", "cull=3:front"})
    EXPECT_FALSE(PlantedDelay::parse(wrong)) << wrong;
}

TEST(RegressionDetection, MissesItsLimitsWhenTwoAreNotFoundOrTwoAlarmsAreFalse) {
  std::vector<TrialResult> results;
  for (const Trial& t : trialsOf(20, 100)) {
    const bool same = t.kind == "nothing";
    results.push_back(
        {t.name(), t.kind, same ? "" : "cull:front=9", {}, {}, true, 1, "times", 5, same ? 0 : 5.2});
  }
  bool met = false;
  detectionTable(results, 20, 100, met);
  EXPECT_TRUE(met);
  const auto spoil = [&](const std::string& kind, std::size_t count) {
    auto spoilt = results;
    for (TrialResult& r : spoilt)
      if (r.kind == kind && count > 0) r.right = false, --count;
    detectionTable(spoilt, 20, 100, met);
    return met;
  };
  EXPECT_TRUE(spoil("cull", 1));
  EXPECT_FALSE(spoil("cull", 2));
  EXPECT_TRUE(spoil("nothing", 1));
  EXPECT_FALSE(spoil("nothing", 2));

  results.front().lengthened = 21;
  EXPECT_NE(detectionTable(results, 20, 100, met).find("not valid, 21.00 % were planted"), std::string::npos);
  EXPECT_FALSE(met) << "what is found was not what was to be found";
  results.front().program = "this";
  const auto read = readTrials(toJsonLine(results.front()));
  ASSERT_EQ(read.size(), 1u);
  EXPECT_EQ(read[0].program, "this");
  EXPECT_FALSE(read[0].valid());
}

TEST(RegressionDetection, PlantsOnceAFrameThoughANodeSimulatesInTwoParts) {
  PlantedDelay planted;
  planted.where = PlantedDelay::Where::Simulate, planted.node = {1, 0}, planted.iterations = 10;
  SpanTimes times({planted});
  for (std::uint64_t frame = 0; frame < 3; ++frame) {
    times.began(Span::App, frame, kNoWall);
    for (const NodeRef node : {NodeRef{1, 0}, NodeRef{1, 1}})
      for (int part = 0; part < 2; ++part) {
        times.began(Span::Simulate, node);
        times.ended(Span::Simulate);
      }
    times.ended(Span::App);
  }
  EXPECT_EQ(times.planted().size(), 3u);
  const auto rows =
      times.rows({}, [](NodeRef node, SpanRow& row) { row.path = std::to_string(node.position); });
  const auto read = spanRows(toJson(rows));
  for (const SpanRow& r : read)
    EXPECT_EQ(r.plantedUs > 0, r.isStage()) << "App is what it lengthens: " << r.name();
}

}  // namespace
}  // namespace stadion::regression
