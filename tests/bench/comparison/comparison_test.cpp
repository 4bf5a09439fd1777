/// What is said of measurements: medians, limits, which other engine counts, the plot.

#include "bench/comparison/comparison_report.h"
#include "bench/comparison/work_precision_plot.h"

#include <cmath>
#include <gtest/gtest.h>

namespace stadion::bench {
namespace {

Measurement of(const std::string& engine, const std::string& name, int n, double ns,
               std::map<std::string, double> m) {
  Measurement r;
  r.engine = engine;
  r.caseName = name;
  r.n = n;
  r.ns = ns;
  r.m = std::move(m);
  return r;
}

std::vector<Finding::Kind> kinds(const Verdict& v) {
  std::vector<Finding::Kind> all;
  for (const Finding& f : v.findings) all.push_back(f.kind);
  return all;
}

using enum Finding::Kind;
using Kinds = std::vector<Finding::Kind>;

TEST(Comparison, ALineIsReadAndWrittenAlike) {
  const std::string line =
      R"({"engine":"ode-lcp","case":"C06","n":4,"ns_per_body_frame":12.5,"m":{"apex":null,"err":0.25}})";
  const auto m = parseMeasurement(line);
  ASSERT_TRUE(m);
  EXPECT_TRUE(m->played());
  EXPECT_TRUE(std::isnan(m->metric("apex")));
  EXPECT_EQ(m->metric("err"), 0.25);
  EXPECT_EQ(toJson(*m), line);
  EXPECT_FALSE(parseMeasurement("WARNING: unstable"));
  EXPECT_FALSE(parseMeasurement(R"({"case":"C06","steps":[1]})"));
  EXPECT_FALSE(parseMeasurement(R"({"engine":"a","case":"b","n":1,"crash":11})")->played());
}

TEST(Comparison, TheMedianCostOfTheRoundsCounts) {
  const Measurement m = medianOf({of("a", "C14", 1, 30, {{"err", 2}, {"worst_frame_ms", 9}}),
                                  of("a", "C14", 1, 10, {{"err", 2}, {"worst_frame_ms", 1}}),
                                  of("a", "C14", 1, 20, {{"err", 2}, {"worst_frame_ms", 4}})});
  EXPECT_EQ(m.ns, 20);
  EXPECT_EQ(m.metric("worst_frame_ms"), 4);
  EXPECT_EQ(m.metric("err"), 2);
}

TEST(Comparison, AnErrorAboveItsLimitIsMissedAndSoIsOneThatIsNoNumber) {
  const auto verdict = [](double err) {
    return kinds(judge("C01_ballistic", {of("stadion", "C01_ballistic", 1, 10, {{"err", err}}),
                                         of("ode-quick", "C01_ballistic", 1, 100, {{"err", 0.2}})}));
  };
  EXPECT_EQ(verdict(1e-12), (Kinds{Met, Met}));
  EXPECT_EQ(verdict(1e-10), (Kinds{Missed, Met}));
  EXPECT_EQ(verdict(std::nan("")), (Kinds{Missed, Met}));
}

TEST(Comparison, CostIsComparedWithTheCheapestAtTheLimitsSetting) {
  const std::vector<Measurement> all{of("stadion", "C01_ballistic", 1, 20, {{"err", 0}}),
                                     of("bullet64", "C01_ballistic", 1, 110, {{"err", 0.2}}),
                                     of("ode-quick", "C01_ballistic", 1, 130, {{"err", 0.2}}),
                                     of("ode-quick", "C01_ballistic", 4, 40, {{"err", 0.1}})};
  const Verdict v = judge("C01_ballistic", all);
  ASSERT_TRUE(v.peer);
  EXPECT_EQ(v.peer->engine, "bullet64");
  EXPECT_EQ(kinds(v), (Kinds{Met, Missed}));  // 20 of 110 is more than a sixth
}

TEST(Comparison, TheContactSchemeOfThePaperHasNoLimitsAndIsNoPeer) {
  const std::vector<Measurement> all{of("stadion", "C01_ballistic", 1, 10, {{"err", 0}}),
                                     of("stadion-paper-1e-3", "C01_ballistic", 1, 1, {{"err", 1}}),
                                     of("bullet64", "C01_ballistic", 1, 100, {{"err", 1}})};
  const Verdict v = judge("C01_ballistic", all);
  EXPECT_EQ(kinds(v), (Kinds{Met, Met}));
  EXPECT_EQ(v.peer, &all[2]);
}

TEST(Comparison, AWallThatWasTunnelledIsNoComparison) {
  const auto ours = of("stadion", "C09_tunnel_v200_ccd", 1, 10,
                       {{"err", 0}, {"tunnelled_of_8", 0}, {"no_rebound_of_8", 0}, {"vel_relerr", 0}});
  const auto through = of("bullet64", "C09_tunnel_v200_ccd", 1, 50, {{"err", 99}, {"tunnelled_of_8", 8}});
  const auto held = of("bullet64", "C09_tunnel_v200_ccd", 4, 300, {{"err", 1}, {"tunnelled_of_8", 0}});
  const auto other = of("ode-lcp", "C09_tunnel_v200_ccd", 1, 1, {{"err", 1}, {"tunnelled_of_8", 0}});
  const std::vector<Measurement> finer{ours, through, held, other}, none{ours, through, other};
  EXPECT_EQ(judge(ours.caseName, finer).peer, &finer[2]);
  const Verdict v = judge(ours.caseName, none);
  EXPECT_EQ(v.peer, nullptr);
  EXPECT_EQ(v.findings.back().kind, Void);
}

TEST(Comparison, AtEqualErrorOnlyThoseCountThatComeAsNear) {
  const std::vector<Measurement> all{of("stadion", "C08_tip", 1, 500, {{"err", 3e-5}, {"stable_tilt", 0}}),
                                     of("ode-quick", "C08_tip", 1, 50, {{"err", 0.1}}),
                                     of("ode-lcp", "C08_tip", 16, 900, {{"err", 9e-5}})};
  const Verdict v = judge("C08_tip", all);
  ASSERT_EQ(v.peer, &all[2]);
  EXPECT_EQ(kinds(v), (Kinds{Met, Met, Met}));
}

TEST(Comparison, WithoutOtherEnginesTheCostIsVoidAndWhatCannotBePlayedIsMissed) {
  EXPECT_EQ(kinds(judge("C01_ballistic", {of("stadion", "C01_ballistic", 1, 20, {{"err", 0}})})),
            (Kinds{Met, Void}));
  Measurement lacking = of("stadion", "C04_discus_40rad", 1, 0, {});
  lacking.unsupported = true;
  EXPECT_EQ(kinds(judge("C04_discus_40rad", {lacking})), (Kinds{Missed}));
}

TEST(Comparison, TheWorstFrameHasALimitOfItsOwn) {
  const auto ball = [](const std::string& engine, double ns, double worst) {
    return of(engine, "C14_pile1000", 1, ns,
              {{"escaped", 0}, {"max_pen", 0}, {"pen_end", 0}, {"E_rise_max", 0}, {"worst_frame_ms", worst}});
  };
  const Verdict v = judge("C14_pile1000", {ball("stadion", 40, 8), ball("bullet64", 100, 10)});
  EXPECT_EQ(kinds(v), (Kinds{Met, Met, Met, Met, Met, Missed}));
}

TEST(Comparison, ThePlotHasALineForEachSettingAndADotForEachStep) {
  const std::string svg = workPrecisionPlot("C01", {of("stadion", "C01", 1, 20, {{"err", 0}}),
                                                    of("ode-lcp", "C01", 1, 100, {{"err", 0.2}}),
                                                    of("ode-lcp", "C01", 4, 400, {{"err", 0.05}})});
  const auto count = [&svg](const std::string& what) {
    std::size_t n = 0;
    for (std::size_t at = svg.find(what); at != svg.npos; at = svg.find(what, at + 1)) ++n;
    return n;
  };
  EXPECT_EQ(count("<polyline"), 2u);
  EXPECT_EQ(count("r='4'"), 3u);
  EXPECT_EQ(count("nan"), 0u);
  EXPECT_NE(workPrecisionPlot("empty", {}).find("nothing was measured"), svg.npos);
}

TEST(Comparison, DotsThatLieOnEachOtherShareALabelAndTheLegendNamesTheHidden) {
  const std::string svg = workPrecisionPlot(
      "C01", {of("stadion", "C01", 1, 100, {{"err", 0.2}}), of("bullet", "C01", 1, 100, {{"err", 0.2}}),
              of("ode", "C01", 4, 101, {{"err", 0.2}}), of("ode", "C01", 8, 4000, {{"err", 1e-6}})});
  EXPECT_NE(svg.find(">n=1,4<"), svg.npos) << svg;
  EXPECT_EQ(svg.find(">1<"), svg.npos);
  EXPECT_NE(svg.find(">8<"), svg.npos);
  EXPECT_NE(svg.find("stadion (under others)"), svg.npos);
  EXPECT_EQ(svg.find("ode (under others)"), svg.npos);
}

TEST(Comparison, WhatRefusedTheCasesMeshHasNoNumbers) {
  const auto m = parseMeasurement(
      R"({"engine":"mujoco","case":"C13","n":1,"ns_per_body_frame":0.0,"m":{"mesh_refused":1}})");
  ASSERT_TRUE(m);
  EXPECT_FALSE(m->played());
  EXPECT_NE(toJson(*m).find(R"("ns_per_body_frame":null)"), std::string::npos) << toJson(*m);
  ASSERT_TRUE(parseMeasurement(toJson(*m))) << "it reads what it writes";
  CaseComparison r{"C13_degenerate_mesh", {*m}, {}};
  EXPECT_NE(tableOf(r).find("refused the mesh"), std::string::npos) << tableOf(r);
}

TEST(Comparison, TheReportNamesWhatWasMissed) {
  CaseComparison r{"C01_ballistic", {of("stadion", "C01_ballistic", 1, 20, {{"err", 1}})}, {}};
  r.verdict = judge(r.name, r.measurements);
  EXPECT_FALSE(allMet({r}));
  EXPECT_NE(summaryOf({r}).find("0 limits met, 1 missed, 1 void"), std::string::npos);
  EXPECT_NE(tableOf(r).find("MISSED"), std::string::npos);
}

}  // namespace
}  // namespace stadion::bench
