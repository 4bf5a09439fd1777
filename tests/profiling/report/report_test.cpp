/// The report of a profile: what it keeps, and that what it is told stays text.

#include "profiling/report/duration_histogram.h"
#include "profiling/report/node_table.h"
#include "profiling/report/report_data.h"
#include "profiling/report/report_recording.h"
#include "tests/engine/scene/show_fixture.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace stadion {
namespace {

using std::chrono::microseconds;

/// A run made up by hand: App, and Cull and Draw of one wall.
struct MadeUpRun {
  NodeNames names;
  ShowProfile profile;
  ReportRecording recording;
  ProfileClock::time_point now = ProfileClock::now();
  double delayed = 0;  ///< [ms] of App, without a processor

  std::uint64_t sampleEvery;  ///< drawing, in two of so many frames; 0: never

  explicit MadeUpRun(std::uint64_t every = 0) : recording(60, {"front"}, names), sampleEvery(every) {}

  void span(std::size_t track, Span what, std::uint64_t frame, std::uint8_t depth, int from, int to,
            NodeRef node = {}, std::uint32_t wall = 0) {
    SpanRecord r;
    r.what = what, r.frame = frame, r.depth = depth, r.node = node;
    r.wall = what == Span::App || what == Span::Swap ? kNoWall : wall;
    r.began = now + microseconds(from), r.ended = now + microseconds(to);
    r.took = r.own = 1e-3 * (to - from);
    r.use.processor = r.took;
    if (what == Span::App) r.use.delayed = delayed;
    const std::uint64_t phase = sampleEvery > 0 ? frame % sampleEvery : ~std::uint64_t{0};
    r.disturbed = what == Span::Draw && (phase == sampleEvery / 2 || phase == sampleEvery / 2 + 1);
    recording.take(track, r), profile.take(track, r);
  }
  /// `late` [ms] more in App than the 4 that it takes.
  void frame(std::uint64_t number, int late = 0) {
    const int app = 4000 + 1000 * late;
    for (std::uint32_t node = 0; node < 60; ++node)
      span(0, Span::Simulate, number, 1, 10 + static_cast<int>(node), 11 + 2 * static_cast<int>(node),
           {1, node});
    span(0, Span::App, number, 0, 0, app);
    span(1, Span::ForFrame, kNoFrame, 0, 0, app);
    span(1, Span::Cull, number, 0, app, app + 1000);
    span(2, Span::Draw, number, 0, app + 1000, app + 9000);
    span(2, Span::Swap, number, 1, app + 9001, app + 9002);
    span(2, Span::ForWalls, number, 0, app + 9001, app + 9003);
    now += microseconds(app + 10000);
  }
};

TEST(KeptFrames, TheLongestFramesAreThereInFullHoweverLongTheyAreOver) {
  MadeUpRun run;
  for (std::uint64_t n = 0; n < 3000; ++n) run.frame(n, n == 500 ? 40 : n == 900 ? 60 : n == 1500 ? 30 : 0);
  const KeptFrames& kept = run.recording.kept();
  ASSERT_EQ(kept.worst().size(), 3U);
  EXPECT_EQ(kept.worst()[0].about, 900U);
  EXPECT_EQ(kept.worst()[1].about, 500U);
  for (std::uint64_t n = 900 - KeptFrames::kBefore; n <= 900 + KeptFrames::kAfter; ++n) {
    ASSERT_TRUE(kept.frames().contains(n)) << n;
    EXPECT_EQ(kept.frames().at(n).facts.frame, n);
  }
  const auto& spans = kept.frames().at(900).spans;
  EXPECT_EQ(std::ranges::count_if(spans, [](const KeptSpan& s) { return s.node.valid(); }),
            static_cast<long>(KeptFrames::kNodesAFrame));
  EXPECT_TRUE(std::ranges::any_of(spans, [](const KeptSpan& s) {
    return s.node == NodeRef{1, 59};
  })) << "the most expensive";
  EXPECT_FALSE(std::ranges::any_of(spans, [](const KeptSpan& s) { return s.node == NodeRef{1, 0}; }));
  EXPECT_EQ(std::ranges::count_if(spans, [](const KeptSpan& s) { return s.what == Span::ForFrame; }), 1)
      << "a wait belongs to the frame that was waited for";
}

TEST(KeptFrames, TheirNumberIsBounded) {
  MadeUpRun run;
  std::size_t most = 0;
  for (std::uint64_t n = 0; n < 6000; ++n) {
    run.frame(n, static_cast<int>(n * 7919 % 23));
    most = std::max(most, run.recording.kept().frames().size());
  }
  constexpr std::size_t kStretch = KeptFrames::kBefore + KeptFrames::kAfter + 1;
  EXPECT_LE(most, KeptFrames::kRecent + 2 + kStretch * (KeptFrames::kWorst + KeptFrames::kCandidates + 1));
}

TEST(KeptFrames, ANormalStretchIsOneOfTypicalPeriod) {
  MadeUpRun run;
  for (std::uint64_t n = 0; n < 1000; ++n) run.frame(n, n < 600 ? 20 : 0);
  const Stretch* normal = run.recording.kept().normal(14);
  ASSERT_TRUE(normal);
  EXPECT_GT(normal->about, 600U);
  EXPECT_NEAR(normal->score, 14, 0.5);
}

TEST(FrameSeries, FramesThatSamplingDisturbedAreNotJudged) {
  MadeUpRun run(8);
  for (std::uint64_t n = 0; n < 800; ++n) run.frame(n, n % 8 == 4 ? 50 : 0);
  std::uint64_t judged = 0;
  for (const auto& [cause, count] : run.recording.series().causes()) {
    EXPECT_EQ(cause, Cause::None) << nameOf(cause);
    judged += count;
  }
  EXPECT_EQ(judged, 499U) << "of eight, two are sampled and one follows; the first has no frame before it";
}

TEST(FrameSeries, ALateFrameHasItsCauseAndItsNode) {
  MadeUpRun run;
  for (std::uint64_t n = 0; n < 100; ++n) run.frame(n, n == 70 ? 50 : 0);
  const auto late = run.recording.series().late();
  ASSERT_EQ(late.size(), 1U);
  EXPECT_EQ(late[0].frame, 70U);
  EXPECT_EQ(late[0].cause, Cause::App);
  EXPECT_EQ(late[0].mostExpensive(), (NodeRef{1, 59}));
}

TEST(DurationHistogram, ItsMarksAreThoseOfTheValuesAndEveryValueIsInABin) {
  std::vector<float> values;
  for (int i = 1; i <= 1000; ++i) values.push_back(static_cast<float>(i) / 100);
  values.push_back(500);
  const DurationHistogram d = durationHistogramOf(values);
  EXPECT_NEAR(d.median, 5.01, 1e-5);
  EXPECT_NEAR(d.p95, 9.51, 1e-5);
  EXPECT_NEAR(d.p99, 9.91, 1e-5);
  EXPECT_EQ(d.most, 500);
  std::size_t sum = 0;
  for (const std::size_t n : d.bins) sum += n;
  EXPECT_EQ(sum, 1001U);
  EXPECT_LT(d.from + d.step * static_cast<double>(d.bins.size()), 13)
      << "one far value does not press the others together";
  EXPECT_GE(d.bins.back(), 1U);
  EXPECT_TRUE(durationHistogramOf({}).bins.empty());
  EXPECT_EQ(durationHistogramOf({3, 3, 3}).median, 3);
}

TEST(NodeTable, NodesBeyondTheMostAreOneRowTogether) {
  ShowFigures figures;
  figures.walls = {"front"};
  for (std::uint32_t i = 0; i < 10; ++i) {
    NodeRow row;
    row.node = {1, i}, row.app = row.total = 10 - i;
    row.name.path = "n" + std::to_string(i);
    row.walls.resize(1);
    figures.nodes.push_back(row);
  }
  const NodeNames names;
  NodeTable table(figures, names, 4);
  ASSERT_EQ(table.nodes().size(), 5U);
  EXPECT_EQ(table.nodes()[4].restCount, 6U);
  EXPECT_EQ(table.nodes()[4].rest.app, 6 + 5 + 4 + 3 + 2 + 1);
}

TEST(ReportPage, WhatScriptsNameThemselvesNeverBecomesMarkup) {
  MadeUpRun run;
  for (std::uint64_t n = 0; n < 60; ++n) run.frame(n);
  const std::string hostile = "</script><script>alert(1)</script><img src=x onerror=alert(2)>\xff\"'&\\";
  ShowFigures figures = figuresOf(run.profile, run.names, {hostile}, "Mesa, llvmpipe");
  for (NodeRow& row : figures.nodes) row.name.path = row.name.file = hostile;
  ReportData data{{hostile, 60, 60, 0.1, {{"walls", hostile}}},
                  figures,
                  run.names,
                  run.recording.series(),
                  run.recording.kept(),
                  run.recording.threads().threads(),
                  {},
                  {}};
  data.dynamics = DynamicsFigures{
      1e-3, {{hostile, hostile, 1, hostile, 0.1, {}, {}, {}, {}, hostile, hostile, {}, {}}}, hostile};
  const std::string page = reportPage(data);
  EXPECT_EQ(page.find("<script>alert"), std::string::npos);
  EXPECT_EQ(page.find("<img"), std::string::npos);
  const auto count = [&](const std::string& what) {
    std::size_t n = 0;
    for (std::size_t at = page.find(what); at != std::string::npos; at = page.find(what, at + 1)) ++n;
    return n;
  };
  EXPECT_EQ(count("<script"), 2U) << "the data and the page's own";
  EXPECT_EQ(count("</script"), 2U);
  const auto json = nlohmann::json::parse(reportJson(data));
  EXPECT_EQ(json["nodes"][0]["path"].get<std::string>().substr(0, 9), "</script>");
}

TEST(ReportPage, ANodeStandsBesideALateFrameOnlyWhereItExplainsIt) {
  MadeUpRun run;
  ShowFixture show;
  show.loader.files["show"] = [](LoadedScene& load) {
    load.lines.assign(60, 1);
    for (int i = 0; i < 60; ++i) addNode<ListeningNode>(load, "node" + std::to_string(i));
  };
  ASSERT_TRUE(show.scene.open("show"));
  run.names.see(show.scene);
  for (std::uint64_t n = 0; n < 100; ++n) {
    run.delayed = n == 80 ? 40 : 0;
    run.frame(n, n == 70 || n == 80 ? 50 : 0);
  }
  const ShowFigures figures = figuresOf(run.profile, run.names, {"front"}, "Mesa, llvmpipe");
  const ReportData data{
      {"show.evs", 60, 100, 0.1, {}},    figures, run.names, run.recording.series(), run.recording.kept(),
      run.recording.threads().threads(), {},      {}};
  const auto late = nlohmann::json::parse(reportJson(data))["late"];
  ASSERT_EQ(late.size(), 2U) << late;
  for (const auto& frame : late) {
    const bool byItself = frame["frame"] == 70;
    EXPECT_EQ(frame["cause"], byItself ? "App over" : "pre-empted");
    EXPECT_EQ(frame["node"] != -1, byItself) << frame;
  }
}

TEST(ReportPage, TenThousandNodesAreAllThereAndNoHeavyPage) {
  MadeUpRun run;
  for (std::uint64_t n = 0; n < 60; ++n) run.frame(n);
  ShowFigures figures =
      figuresOf(run.profile, run.names, {"front", "left", "right", "floor"}, "Mesa, llvmpipe");
  for (std::uint32_t i = 0; i < 10'000; ++i) {
    NodeRow row;
    row.node = {2, i}, row.name.path = "pillar_" + std::to_string(i), row.name.line = i;
    row.name.file = "a/folder/with/a/rather/long/name/grid.evs";
    row.cull = 0.00012345678 * (1 + i), row.draw = 0.0034567891 * (1 + i), row.total = row.cull + row.draw;
    row.walls.resize(4, {row.cull / 4, {row.draw / 8, row.draw / 8}});
    row.drawMeasured = i != 7, row.draw = i == 7 ? 0 : row.draw;
    figures.nodes.push_back(row);
  }
  const ReportData data{
      {"grid.evs", 60, 60, 0.1, {}},     figures, run.names, run.recording.series(), run.recording.kept(),
      run.recording.threads().threads(), {},      {}};
  const auto json = nlohmann::json::parse(reportJson(data));
  EXPECT_EQ(json["nodes"].size(), figures.nodes.size());
  EXPECT_LT(reportPage(data).size(), 3'000'000U);
  std::size_t unmeasured = 0;
  for (const auto& node : json["nodes"]) unmeasured += node["costs"][2].is_null() ? 1 : 0;
  EXPECT_GE(unmeasured, 1U) << "what had no turn is not 0";
}

TEST(ReportPage, ItNeedsNothingBesideItself) {
  MadeUpRun run;
  for (std::uint64_t n = 0; n < 60; ++n) run.frame(n);
  const ShowFigures figures = figuresOf(run.profile, run.names, {"front"}, "Mesa, llvmpipe");
  const ReportData data{
      {"show.evs", 60, 60, 0.1, {}},     figures, run.names, run.recording.series(), run.recording.kept(),
      run.recording.threads().threads(), {},      {}};
  std::string page = reportPage(data);
  const std::string svg = "http://www.w3.org/2000/svg";  // a name, not an address
  for (std::size_t at = page.find(svg); at != std::string::npos; at = page.find(svg))
    page.erase(at, svg.size());
  for (const char* outside : {"http:", "https:", "src=", "@import", "url(h", "fetch(", "XMLHttpRequest"})
    EXPECT_EQ(page.find(outside), std::string::npos) << outside;
  EXPECT_NE(page.find("default-src 'none'"), std::string::npos);
}

TEST(ReportPage, ARunWithoutFramesIsAPageToo) {
  const MadeUpRun run;
  const ShowFigures figures = figuresOf(run.profile, run.names, {"front"}, "Mesa, llvmpipe");
  const ReportData data{{"show.evs", 60, 0, 0, {}}, figures, run.names, run.recording.series(),
                        run.recording.kept(),       {},      {},        {}};
  EXPECT_TRUE(nlohmann::json::accept(reportJson(data)));
}

}  // namespace
}  // namespace stadion
