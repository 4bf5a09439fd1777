/// Which nodes are reported, and which give up what, when spans show that nodes and frames take too long. The
/// spans are made up: no clock is asked.

#include "profiling/budget/degradation_governor.h"

#include "engine/nodes/light_node.h"
#include "engine/nodes/lod_node.h"
#include "engine/nodes/scene_node.h"
#include "tests/engine/scene/show_fixture.h"

#include <gtest/gtest.h>

namespace stadion {
namespace {

using enum DegradationStep;

/// A show of some listening nodes with terms, whose costs a test makes up.
struct Governed : ShowFixture {
  NodeNames names;
  std::vector<std::string> told;
  std::unique_ptr<DegradationGovernor> governor;
  std::uint64_t at = 0;
  bool sampled = false;                     ///< the coming frame's drawing is looked at
  std::optional<NodeTerms> guest;           ///< of the node in the annex
  std::optional<NodeTerms> dusk;            ///< of the annex' sky
  std::map<NodeRef, std::uint32_t> levels;  ///< as they have been decided; of no node: stress

  explicit Governed(std::vector<NodeTerms> terms, bool scalable = false, GovernorOptions options = {}) {
    loader.files["show"] = [=](LoadedScene& load) {
      load.lines.assign(terms.size() + 1, 1);
      for (std::size_t i = 0; i < terms.size(); ++i) {
        addNode<ListeningNode>(load, "node" + std::to_string(i));
        load.terms[static_cast<std::uint32_t>(i)] = terms[i];
      }
      load.lines.push_back(1);
      addNode<SceneNode>(load, "annex", PlaceAttributes{}, "annex", Nanoseconds{0}, false);
      if (scalable)
        addNode<LodNode>(load, "tree", PlaceAttributes{}, std::vector<NodeRef>{}, std::vector<double>{5});
    };
    loader.files["annex"] = [this](LoadedScene& load) {
      load.lines.assign(2, 1);
      addNode<ListeningNode>(load, "guest");
      if (guest) load.terms[0] = *guest;
      if (!dusk) return;
      addNode<SkyNode>(load, "dusk", SkyRecord{});
      load.terms[1] = *dusk;
    };
    EXPECT_TRUE(scene.open("show"));
    options.walls = {"front", "left"};
    options.tell = [this](const std::string& line) { told.push_back(line); };
    governor = std::make_unique<DegradationGovernor>(options, names);
    names.see(scene);
    governor->followLoads(scene);
  }

  static SpanRecord span(Span what, std::uint64_t frame, double ms, std::uint32_t wall = kNoWall,
                         NodeRef node = {}) {
    SpanRecord r;
    r.what = what, r.frame = frame, r.wall = wall, r.node = node, r.took = ms;
    return r;
  }
  /// One frame: what nodes take in App (if they are not at rest), and what the walls' Draw takes.
  void frame(std::vector<double> nodes, std::vector<double> draws = {1, 1}) {
    for (const DegradationDecision& d : governor->decide(at)) levels[{d.load, d.position}] = d.level;
    double app = 0.1;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      const NodeRef ref{1, static_cast<std::uint32_t>(i)};
      const LoadedScene* load = scene.tree().load(1);
      if (degradationAt(load->terms.at(ref.position).gives, levels[ref]).rests) continue;
      governor->take(0, span(Span::Simulate, at, nodes[i], kNoWall, ref));
      app += nodes[i];
    }
    governor->take(0, span(Span::App, at, app));
    for (std::size_t w = 0; w < draws.size(); ++w) drew(w, draws[w]);
    governor->take(1, span(Span::Swap, at, 0.1));
    governor->caughtUp();
    ++at;
  }
  void drew(std::size_t wall, double ms) {
    SpanRecord r = span(Span::Draw, at, ms, static_cast<std::uint32_t>(wall));
    r.disturbed = sampled;
    governor->take(1 + wall, r);
  }
  /// The annex comes or goes.
  void annex(CommandId command) {
    const std::uint64_t before = scene.tree().version();
    scene.command("annex", command, {}, 0);
    for (int i = 0; i < 200 && scene.tree().version() == before; ++i) ShowFixture::frame();
    ASSERT_NE(scene.tree().version(), before);
    names.see(scene);
    governor->followLoads(scene);
  }
  void frames(std::uint64_t count, std::vector<double> nodes, std::vector<double> draws = {1, 1}) {
    for (; count > 0; --count) frame(nodes, draws);
  }
  std::uint32_t level(std::uint32_t node) { return levels[{1, node}]; }
  std::uint32_t stress() { return levels[NodeRef{}]; }
};

TEST(DegradationGovernor, AStallIsToldByNameWithinTwoFramesAndAnswered) {
  Governed g({{0.8, {Half, Rest}, 1}});
  g.frames(100, {0.2});
  g.frames(2, {50});
  ASSERT_FALSE(g.told.empty());
  EXPECT_EQ(g.told[0], "over budget: \"node0\" show:1 took 50 ms of 0.8 in frame 100, most of it App");
  EXPECT_EQ(g.governor->overrunOf(101)->ms, 50);
  g.frames(4, {50});
  EXPECT_EQ(g.level(0), 3U);
}

TEST(DegradationGovernor, OverrunsAreToldOnceInTenSecondsAndCounted) {
  Governed g({{1, {}, 1}});
  g.frames(600, {1.4});
  EXPECT_EQ(g.told.size(), 1U);
  g.frames(60, {1.4});
  ASSERT_EQ(g.told.size(), 2U);
  EXPECT_NE(g.told[1].find("600 frames since"), std::string::npos) << g.told[1];
  EXPECT_GE(g.governor->reports().at(0).overruns, 650U);
}

TEST(DegradationGovernor, AStallIsToldThoughASmallOverrunWasToldJustBefore) {
  Governed g({{0.8, {}, 1}});
  g.frames(100, {0.9});
  ASSERT_EQ(g.told.size(), 1U);
  g.frame({50});
  g.frames(3, {0.2});
  ASSERT_EQ(g.told.size(), 2U);
  EXPECT_NE(g.told[1].find("took 50 ms of 0.8 in frame 100"), std::string::npos) << g.told[1];
  g.frames(60, {20});
  EXPECT_EQ(g.told.size(), 2U) << "it is known to be bad";
}

/// A node whose drawing is looked at in every 16th frame, unless it is hidden.
struct Drawn : Governed {
  Drawn(double budget, std::vector<DegradationStep> gives) : Governed({{budget, std::move(gives), 1}}) {}

  void draw(std::uint64_t count, double ms) {
    for (; count > 0; --count) {
      const bool hidden = degradationAt(scene.tree().load(1)->terms.at(0).gives, level(0)).hidden;
      if (at % 16 == 9 && !hidden) {
        const IsolatedDrawTime alone{at, 0, 0, Span::Draw, ms, 0};
        governor->take(alone, {{NodeRef{1, 0}, 1}});
      }
      frame({hidden ? 1e-4 * static_cast<double>(1 + at % 3) : 0});  // being hidden is some work, too
    }
  }
};

TEST(DegradationGovernor, WhatDrawingNothingTakesIsTakenOffOnce) {
  Governed g({{1, {}, 1}});
  for (int i = 0; i < 100; ++i) {
    for (int piece = 0; g.at % 16 == 9 && piece < 8; ++piece)
      g.governor->take(IsolatedDrawTime{g.at, 0, 0, Span::Draw, 0.2, 0.15}, {{NodeRef{1, 0}, 1}});
    g.frame({0});
  }
  EXPECT_NEAR(g.governor->reports().at(0).worst, 1.6, 1e-9) << "IsolatedDrawTime::ms is without it";
  // The first sample alone says nothing yet.
  EXPECT_GT(g.governor->reports().at(0).overruns, 60U);
}

TEST(DegradationGovernor, WhatComesToItsTurnSeldomCountsUntilItsNextButOne) {
  Governed g({{1, {}, 1}});
  constexpr std::uint64_t kRound = 1000;
  for (std::uint64_t i = 0; i < 3 * kRound; ++i) {
    const NodeShare whole{NodeRef{1, 0}, 1};
    if (g.at % kRound == 9)
      g.governor->take(IsolatedDrawTime{g.at, 0, 0, Span::Draw, 3, 0.1, kRound}, {whole});
    g.frame({0});
  }
  EXPECT_NEAR(static_cast<double>(g.governor->reports().at(0).overruns), 2 * kRound, 20);
  g.frames(2 * kRound, {0});
  EXPECT_EQ(g.governor->overrunOf(g.at), std::nullopt) << "it has not come again: it is out of sight";
}

TEST(DegradationGovernor, ShortVisitsCountForAllThatTheHolderStandsBelow) {
  Governed g({{1, {Rest}, 1}});
  ASSERT_TRUE(g.governor->accounts());
  EXPECT_EQ(g.governor->accounts()->holders().at(g.governor->accounts()->of({1, 0})), (NodeRef{1, 0}));
  EXPECT_EQ(g.governor->accounts()->of({1, 1}), NodeAccounts::kNone);
  for (int i = 0; i < 10; ++i) {
    g.governor->take(ShortVisits{g.at, {1, 0}, 5});
    g.frame({0});
  }
  EXPECT_EQ(g.level(0), 1U);
  EXPECT_NEAR(g.governor->reports().at(0).worst, 5, 1e-9);
}

TEST(DegradationGovernor, ThatDrawingIsDoneElsewhereIsToldOnceAndOfEachBudget) {
  GovernorOptions options;
  options.drawnElsewhere = true;
  Governed g({{1, {}, 1}, {2, {}, 1}}, false, options);
  g.frames(10, {0, 0});
  g.annex(CommandId::Load);
  g.frames(10, {0, 0});
  ASSERT_EQ(g.told.size(), 1U);
  EXPECT_EQ(g.told[0].find("the budget of \"node0\" show:1 counts App and Cull only"), 0U) << g.told[0];
  for (const BudgetReport& r : g.governor->reports()) EXPECT_FALSE(r.drawCounted) << r.name;
  Governed here({{1, {}, 1}});
  here.frames(10, {0});
  EXPECT_TRUE(here.told.empty());
  EXPECT_TRUE(here.governor->reports().at(0).drawCounted);
}

TEST(DegradationGovernor, WhatIsHiddenCostsNothing) {
  Drawn g(1, {Hide});
  g.draw(120, 3);
  EXPECT_EQ(g.level(0), 1U);
  const std::uint64_t before = g.governor->reports().at(0).overruns;
  g.draw(40, 3);
  EXPECT_EQ(g.governor->reports().at(0).overruns, before);
}

TEST(DegradationGovernor, WhatWasHiddenIsShownAgainWithinSecondsOnceItIsCheap) {
  Drawn g(1, {Hide});
  g.draw(120, 3);
  ASSERT_EQ(g.level(0), 1U);
  g.draw(300, 0.3);
  EXPECT_EQ(g.level(0), 0U);
}

TEST(DegradationGovernor, WhatIsDearWheneverItIsShownIsTriedLessAndLessOften) {
  Drawn g(1, {Hide});
  g.draw(6000, 3);
  const std::uint64_t early = g.governor->reports().at(0).changes;
  g.draw(6000, 3);
  EXPECT_LT(g.governor->reports().at(0).changes - early, 8U);
  EXPECT_LT(early, 24U);
}

TEST(DegradationGovernor, AGovernorThatDoesNotActOnlyReports) {
  GovernorOptions options;
  options.acts = false;
  Governed g({{0.8, {Half, Rest}, 1}}, true, options);
  g.frames(300, {50}, {40, 40});
  EXPECT_FALSE(g.told.empty());
  EXPECT_EQ(g.level(0), 0U);
  EXPECT_EQ(g.stress(), 0U);
  EXPECT_FALSE(g.governor->stress());
}

TEST(DegradationGovernor, TheSlowestWallPutsTheWholeShowUnderStress) {
  Governed g({}, true);
  g.frames(60, {}, {5, 5});
  EXPECT_EQ(g.stress(), 0U);
  g.frames(60, {}, {5, 20});
  EXPECT_EQ(g.stress(), 8U);  // four times, the most
  g.frames(300, {}, {5, 5});
  EXPECT_EQ(g.stress(), 0U);
}

TEST(DegradationGovernor, StressIsToldWhenItBeginsAndWhenItCanDoNoMoreOnceInTenSeconds) {
  Governed g({}, true);
  g.frames(60, {}, {5, 20});
  ASSERT_EQ(g.told.size(), 2U);
  EXPECT_EQ(g.told[0], "under stress: from frame 2 on everything counts as 1.19 times farther away");
  EXPECT_NE(g.told[1].find("counts as 4 times farther away, the most it may"), std::string::npos)
      << g.told[1];
  EXPECT_EQ(g.governor->stress()->now, 4);
  EXPECT_EQ(g.governor->stress()->changes, 8U);
  g.frames(150, {}, {5, 5});
  g.frames(60, {}, {5, 20});
  EXPECT_EQ(g.told.size(), 2U);
  g.frames(400, {}, {5, 5});
  EXPECT_EQ(g.governor->stress()->now, 1);
  EXPECT_EQ(g.governor->stress()->highest, 4);
  g.frames(60, {}, {5, 20});
  EXPECT_EQ(g.told.size(), 4U);
}

TEST(DegradationGovernor, WhatComesAndGoesAllDayIsReportedOnce) {
  Governed g({{1, {}, 1}});
  g.guest = NodeTerms{1, {Rest}, 1};
  std::uint32_t file = 1;  // loads are numbered as they come
  for (int visit = 0; visit < 20; ++visit) {
    g.annex(CommandId::Load), ++file;
    for (int i = 0; i < 30; ++i) {
      g.governor->take(0, Governed::span(Span::Simulate, g.at, 1.0 + visit % 4, kNoWall, {file, 0}));
      g.frame({0});
    }
    g.annex(CommandId::Unload);
  }
  const std::vector<BudgetReport> reports = g.governor->reports();
  ASSERT_EQ(reports.size(), 2U);
  const BudgetReport& guest = reports[0].name == "annex/guest" ? reports[0] : reports[1];
  // A frame is judged with the next one: a visit's last one no more, but the one before it (of the first
  // there is none), in which the guest cost nothing.
  EXPECT_EQ(guest.frames, 20U * 30U - 1);
  EXPECT_EQ(guest.overruns, 15U * 29U);
  EXPECT_NEAR(guest.mean, 2.5 * 20 * 29 / (20 * 30 - 1), 1e-9);
  EXPECT_EQ(guest.worst, 4);
  EXPECT_GT(guest.changes, 10U);
  EXPECT_EQ(guest.highest, 1U);
  EXPECT_EQ(guest.now, 0U) << "it is not there";
}

TEST(DegradationGovernor, TheSkyThatIsSeenTakesWhatTheBackgroundDoes) {
  Governed g({});
  g.dusk = NodeTerms{0.5, {}, 1};
  g.annex(CommandId::Load);
  for (int i = 0; i < 100; ++i) {
    if (g.at % 16 == 9) g.governor->take(IsolatedDrawTime{g.at, 0, 0, Span::Sky, 2, 0}, {});
    g.frame({});
  }
  const BudgetReport sky = g.governor->reports().at(0);
  EXPECT_EQ(sky.name, "annex/dusk");
  EXPECT_EQ(sky.worst, 2);
  EXPECT_EQ(sky.worstStage, "Draw of wall front");
  EXPECT_GT(sky.overruns, 60U);
  EXPECT_TRUE(mayBeDrawn(g.scene.find({2, 1}))) << "else it is not looked at";
}

TEST(NodeCosts, ASkyIsSeenWhileItsNodeIsHiddenUntilAnotherOneIs) {
  const NodeRef scene{1, 0}, dusk{2, 0}, dawn{3, 0};
  const std::vector<GovernedNode> nodes{{scene, {1, {Hide}, 1}, true}, {dusk, {1, {}, 1}, true}};
  const std::map<NodeRef, std::vector<std::size_t>> above{{scene, {0}}, {dusk, {1, 0}}};
  NodeCosts costs;
  costs.govern(nodes, above, dusk);
  const IsolatedDrawTime background{10, 0, 0, Span::Sky, 2, 0};
  costs.take(background, {});
  costs.drawnOtherwise(0, 12, true);
  EXPECT_EQ(costs.of(20)[0].cost.drawn, 2);
  EXPECT_EQ(costs.of(20)[1].cost.drawn, 2);
  costs.govern(nodes, above, dawn);
  costs.take(background, {});
  EXPECT_EQ(costs.of(20)[0].cost.drawn, 0);
  EXPECT_EQ(costs.of(20)[1].cost.drawn, 0);
}

TEST(DegradationGovernor, WithoutLevelsThereIsNoStress) {
  Governed g({});
  g.frames(200, {}, {30, 30});
  EXPECT_EQ(g.stress(), 0U);
}

TEST(DegradationGovernor, WhenTheFrameIsOverTheLowestPriorityGivesUpFirst) {
  Governed g({{0, {Half, Rest}, 5}, {0, {Half, Rest}, 2}});
  g.frames(100, {4, 4});
  EXPECT_EQ(g.level(0), 0U);
  g.frames(30, {12, 12});
  EXPECT_EQ(g.level(1), 3U);  // then 12 ms are left, which fit
  EXPECT_EQ(g.level(0), 0U);
}

TEST(DegradationGovernor, WhatMakesAppShorterIsNotGivenUpForDrawNorTheOtherWayRound) {
  const std::vector<NodeTerms> terms{{0, {Half, Rest}, 1}, {0, {Lod, Hide}, 5}};
  Governed draws(terms);
  draws.frames(60, {1}, {40, 40});
  EXPECT_EQ(draws.level(0), 0U) << "its simulation is no load";
  EXPECT_EQ(draws.level(1), 4U);
  Governed simulates(terms);
  simulates.frames(60, {40});
  EXPECT_EQ(simulates.level(0), 3U);
  EXPECT_EQ(simulates.level(1), 0U);
}

TEST(DegradationGovernor, StressComesBeforeDegradationForTheFramesSake) {
  Governed g({{0, {Half, Rest}, 1}}, true);
  g.frames(3, {1}, {25, 25});
  EXPECT_GT(g.stress(), 0U);
  EXPECT_EQ(g.level(0), 0U);
}

TEST(DegradationGovernor, WhatIsGivenUpForTheFrameStaysSoWhateverComesOrGoes) {
  Governed g({{0, {Half, Rest}, 5}, {0, {Half, Rest}, 2}});
  g.frames(100, {4, 4});
  g.frames(30, {12, 12});
  ASSERT_EQ(g.level(1), 3U);
  g.annex(CommandId::Load);
  g.frames(20, {12, 12});
  EXPECT_EQ(g.level(1), 3U);
  EXPECT_EQ(g.level(0), 0U);
  g.annex(CommandId::Unload);
  g.frames(20, {12, 12});
  EXPECT_EQ(g.level(1), 3U);
  EXPECT_EQ(g.level(0), 0U);
}

TEST(DegradationGovernor, ANewNodeOfLowerPriorityGivesUpBeforeThoseThatHaveAlready) {
  Governed g({{0, {Half, Rest}, 5}, {0, {Half, Rest}, 2}});
  g.guest = NodeTerms{0, {Rest}, 1};
  g.frames(100, {4, 4});
  g.frames(30, {12, 12});
  ASSERT_EQ(g.level(1), 3U);
  g.annex(CommandId::Load);
  g.frames(3, {12, 12});
  EXPECT_EQ((g.levels[NodeRef{2, 0}]), 1U);
  EXPECT_EQ(g.level(1), 3U);
  EXPECT_EQ(g.level(0), 0U);
}

TEST(DegradationGovernor, WhatIsHiddenForItsBudgetStaysHiddenWhenSomethingElseComes) {
  Drawn g(1, {Hide});
  g.draw(120, 3);
  ASSERT_EQ(g.level(0), 1U);
  g.annex(CommandId::Load);
  const std::uint64_t before = g.governor->reports().at(0).overruns;
  g.draw(16, 3);
  EXPECT_EQ(g.level(0), 1U);
  EXPECT_EQ(g.governor->reports().at(0).overruns, before);
}

TEST(DegradationGovernor, OneDearSampleOfDrawingIsNoOverrunAndTakesNothing) {
  Drawn g(1, {Hide});
  g.draw(200, 0.2);
  g.draw(16, 4);
  g.draw(200, 0.2);
  EXPECT_EQ(g.level(0), 0U);
  EXPECT_EQ(g.governor->reports().at(0).overruns, 0U);
  EXPECT_EQ(g.governor->reports().at(0).changes, 0U);
}

TEST(DegradationGovernor, WhatWasNeverLookedAtIsNotSaidToCostNothing) {
  Drawn g(1, {Hide});
  g.frames(10, {});
  EXPECT_TRUE(g.governor->reports().at(0).drawMeasured) << "it was not seen";
  g.governor->take({Span::Fill, g.at, 0, 0.01, {NodeRef{1, 0}}});
  const std::uint64_t before = g.governor->reports().at(0).frames;
  g.frames(100, {});
  EXPECT_FALSE(g.governor->reports().at(0).drawMeasured);
  EXPECT_LE(g.governor->reports().at(0).frames, before + 1);
  g.draw(64, 0.5);
  EXPECT_TRUE(g.governor->reports().at(0).drawMeasured);
  EXPECT_NEAR(g.governor->reports().at(0).mean, 0.5, 0.2);
}

TEST(DegradationGovernor, TwoDearSamplesOfDrawingAreEnough) {
  Drawn g(1, {Hide});
  g.draw(200, 0.2);
  g.draw(36, 4);
  EXPECT_EQ(g.level(0), 1U);
  EXPECT_GT(g.governor->reports().at(0).overruns, 0U);
}

TEST(DegradationGovernor, WhatLookingAtDrawingTakesPutsNothingUnderStress) {
  Governed g({}, true);
  const double period = 1000.0 / 60;
  for (int i = 0; i < 3000; ++i) {
    const int phase = i % 16;
    g.sampled = phase == 8 || phase == 9;
    g.frame({}, {(g.sampled || phase == 10 ? 1.3 : 0.85) * period, 1});
  }
  EXPECT_EQ(g.governor->stress()->highest, 1);
}

TEST(DegradationGovernor, NoMoreThanFourDecisionsTakeEffectInAFrame) {
  Governed g(std::vector<NodeTerms>(6, {0.5, {Rest}, 1}));
  g.frames(60, std::vector<double>(6, 0.1));
  const std::vector<double> stall(6, 20);
  std::size_t most = 0;
  for (int i = 0; i < 12; ++i) {
    const auto before = g.levels;
    g.frame(stall);
    std::size_t changed = 0;
    for (const auto& [node, level] : g.levels) {
      const auto was = before.find(node);
      changed += level != (was == before.end() ? 0 : was->second);
    }
    most = std::max(most, changed);
  }
  EXPECT_EQ(most, 4U);
  for (std::uint32_t i = 0; i < 6; ++i) EXPECT_EQ(g.level(i), 1U) << i;
}

}  // namespace
}  // namespace stadion
