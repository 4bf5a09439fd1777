/// The figures of a profile: a frame's time, added up by node and stage.

#include "engine/plain_text/csv_field.h"
#include "profiling/report/show_figures.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <map>
#include <nlohmann/json.hpp>

namespace stadion {
namespace {

constexpr NodeRef kBall{1, 0}, kStone{1, 1};
constexpr std::string_view kMesa = "Mesa, llvmpipe";

/// Spans made up by hand, as a reader gets them.
SpanRecord record(Span what, std::uint64_t frame, std::uint32_t wall, NodeRef node, double ms) {
  SpanRecord r;
  r.frame = frame, r.wall = wall, r.node = node, r.what = what;
  r.took = r.own = ms;
  r.depth = isStage(what) ? 0 : 1;
  return r;
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

}  // namespace
}  // namespace stadion
