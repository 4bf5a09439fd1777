// What the planned pipeline does, against schedules that can be told by hand.
#include "profiling/plan/cost_probe.h"
#include "profiling/plan/costs_file.h"
#include "profiling/plan/diagram.h"
#include "profiling/plan/forecast.h"
#include "profiling/plan/simulation.h"

#include <algorithm>
#include <gtest/gtest.h>

namespace stadion::plan {
namespace {

/// Every wall alike, one picture.
std::vector<FrameCost> frameOf(double app, double cull, double calls, double raster = 0,
                               std::size_t walls = 1, double atOnce = 1) {
  FrameCost cost;
  cost.app = app;
  cost.walls.assign(walls, {cull, {{calls, raster, atOnce}}});
  return {cost};
}

Plan planned(bool pipelined, double cores, std::size_t walls = 1) {
  Plan plan;
  plan.pipelined = pipelined, plan.walls = walls, plan.machine.cores = cores;
  return plan;
}

Forecast forecast(const std::vector<FrameCost>& costs, const Plan& plan) {
  return forecastOf(scheduleOf(costs, plan), plan);
}

Process computing(Simulation& s, double work, double& end) {
  co_await s.compute(0, work);
  end = s.now();
}

Process takesOne(Simulation& s, int& left, double& when) {
  co_await s.until([&left] { return left > 0; });
  --left;
  co_await s.compute(0, 1);
  ++left;
  when = s.now();
}

TEST(Simulation, ThreadsShareAProcessorAlike) {
  Simulation s({1});
  double longer = 0, shorter = 0;
  s.start(computing(s, 3, longer));
  s.start(computing(s, 1, shorter));
  s.run();
  EXPECT_DOUBLE_EQ(shorter, 2);
  EXPECT_DOUBLE_EQ(longer, 4);
  EXPECT_DOUBLE_EQ(s.busy(0), 4);
}

TEST(Simulation, WhatOneTakesAnotherWaitsFor) {
  Simulation s({4});
  int left = 1;
  double first = 0, second = 0;
  s.start(takesOne(s, left, first));
  s.start(takesOne(s, left, second));
  s.run();
  EXPECT_DOUBLE_EQ(first, 1);
  EXPECT_DOUBLE_EQ(second, 2);
}

TEST(Schedule, OneThreadTakesTheSumOfTheStages) {
  const Forecast f = forecast(frameOf(2, 3, 4, 5), planned(false, 8));
  EXPECT_NEAR(f.period, 14, 1e-9);
  EXPECT_NEAR(f.latency, 14, 1e-9);
}

TEST(Schedule, OverlappedStagesTakeAsLongAsTheLongest) {
  EXPECT_NEAR(forecast(frameOf(2, 3, 7), planned(true, 3)).period, 7, 1e-9);
  EXPECT_NEAR(forecast(frameOf(9, 3, 7), planned(true, 3)).period, 9, 1e-9);
  EXPECT_EQ(forecast(frameOf(9, 3, 7), planned(true, 8)).bottleneck, "App");
  EXPECT_EQ(forecast(frameOf(2, 3, 7), planned(true, 8)).bottleneck, "Draw 1");
}

TEST(Schedule, OnOneCoreOverlappedStagesTakeTheirSum) {
  const Forecast f = forecast(frameOf(2, 3, 7), planned(true, 1));
  EXPECT_NEAR(1000 / f.perSecond, 12, 0.6);
  EXPECT_EQ(f.bottleneck, "processors");
}

TEST(Schedule, AppWaitsWhenTheWallsFallBehind) {
  const Plan plan = planned(true, 8);
  const Schedule s = scheduleOf(frameOf(1, 1, 10), plan);
  EXPECT_NEAR(forecastOf(s, plan).period, 10, 1e-9);
  // Three slots, a list that is drawn and one that is ready: so far is App ahead, and no farther.
  EXPECT_NEAR(forecastOf(s, plan).latency, 50, 10);
  EXPECT_EQ(s.shown.size(), plan.frames);
}

TEST(Schedule, AllWallsSwapTogetherWithTheSlowest) {
  std::vector<FrameCost> costs = frameOf(1, 1, 4, 0, 2);
  costs[0].walls[1].pictures[0] = {0, 9, 1};
  Plan plan = planned(true, 8, 2);
  plan.rasterisers = 2;
  const Schedule s = scheduleOf(costs, plan);
  EXPECT_NEAR(forecastOf(s, plan).period, 9, 1e-9);
  double waited = 0;
  for (const Bar& b : s.bars)
    if (b.what == Activity::ForWalls) waited += b.end - b.begin;
  EXPECT_NEAR(waited / static_cast<double>(s.shown.size()), 5, 0.1);
}

TEST(Schedule, LockedFramesTakeWholeTicks) {
  Plan plan = planned(false, 4);
  plan.pace = Pace::Lock, plan.rate = 50;
  EXPECT_NEAR(forecast(frameOf(1, 1, 10), plan).period, 20, 1e-9);
  EXPECT_NEAR(forecast(frameOf(1, 1, 21), plan).period, 40, 1e-9);
  plan.pace = Pace::Float;
  EXPECT_NEAR(forecast(frameOf(1, 1, 21), plan).period, 23, 1e-9);
}

TEST(Schedule, ALiveShowLeavesFramesOutAndIsYounger) {
  Plan plan = planned(true, 8);
  plan.pace = Pace::Lock, plan.rate = 100;
  plan.newest = true;
  const Schedule live = scheduleOf(frameOf(1, 1, 45), plan);
  plan.newest = false;
  const Schedule every = scheduleOf(frameOf(1, 1, 45), plan);
  EXPECT_LT(live.shown.size(), 20u);
  EXPECT_EQ(every.shown.size(), plan.frames);
  EXPECT_LT(forecastOf(live, plan).latency, 0.7 * forecastOf(every, plan).latency);
}

TEST(Schedule, OneFrameInFlightIsAsYoungAsItsStagesTogether) {
  Plan plan = planned(true, 8);
  plan.mostInFlight = 1;
  const Forecast one = forecast(frameOf(2, 3, 10), plan);
  EXPECT_NEAR(one.latency, 15, 1e-9) << "each frame waits for the one before";
  EXPECT_NEAR(one.period, 15, 1e-9);
  plan.mostInFlight = 2;
  const Forecast two = forecast(frameOf(2, 3, 10), plan);
  EXPECT_NEAR(two.period, 10, 1e-9);
  EXPECT_NEAR(two.latency, 20, 1e-9);
  plan.mostInFlight = 0;
  EXPECT_GT(forecast(frameOf(2, 3, 10), plan).latency, two.latency);
}

TEST(Schedule, ALiveShowCountsFramesInFlightFromCull) {
  Plan plan = planned(true, 8);
  plan.pace = Pace::Lock, plan.rate = 200, plan.newest = true, plan.mostInFlight = 1;
  const Forecast f = forecast(frameOf(1, 2, 20), plan);
  EXPECT_NEAR(f.period, 22, 1e-9);
  EXPECT_LT(f.latency, 22 + 1 + 5.0 + 1e-9) << "Cull takes the newest frame, at most a tick old";
}

TEST(Schedule, DrawThatBeginsEarlySavesTheRestOfCull) {
  std::vector<FrameCost> costs = frameOf(1, 8, 10);
  costs[0].walls[0].cullBesideDraw = 6;
  Plan plan = planned(true, 8);
  plan.mostInFlight = 1;
  const double early = forecast(costs, plan).latency;
  plan.drawBeginsEarly = false;
  EXPECT_NEAR(forecast(costs, plan).latency, 19, 1e-9);
  EXPECT_NEAR(early, 13, 1e-9);
  costs[0].walls[0].pictures[0].calls = 2;
  plan.drawBeginsEarly = true;
  EXPECT_NEAR(forecast(costs, plan).latency, 9, 1e-9) << "no list is drawn before it is complete";
}

TEST(Schedule, WallsOfOneRasteriserQueueForIt) {
  const std::vector<FrameCost> costs = frameOf(0.1, 0.1, 0, 10, 2);
  Plan plan = planned(true, 8, 2);
  EXPECT_NEAR(forecast(costs, plan).period, 20, 1e-9);
  EXPECT_EQ(forecast(costs, plan).bottleneck, "turns of the walls");
  plan.rasterisers = 2;
  EXPECT_NEAR(forecast(costs, plan).period, 10, 1e-9);
  plan.rasterisers = 1, plan.machines = 2;
  EXPECT_NEAR(forecast(costs, plan).period, 10, 1e-9);
}

TEST(Schedule, CallsOverlapOtherWallsPixelsOnlyIfTurnsDoNotLastUntilThose) {
  const std::vector<FrameCost> costs = frameOf(0.1, 0.1, 5, 5, 2);
  Plan plan = planned(true, 8, 2);
  EXPECT_NEAR(forecast(costs, plan).period, 20, 1e-9);
  plan.waitsInTurn = false;
  EXPECT_LT(forecast(costs, plan).period, 15.1);
}

TEST(Schedule, MoreRasteriserThreadsShortenPicturesThatKeepThemBusy) {
  Plan plan = planned(false, 8);
  EXPECT_NEAR(forecast(frameOf(0, 0, 1, 8, 1, 2), plan).period, 5, 1e-9);
  plan.machine.rasterThreads = 2;
  EXPECT_NEAR(forecast(frameOf(0, 0, 1, 8, 1, 2), plan).period, 3, 1e-9);
}

TEST(Schedule, MoreWallsThanWereMeasuredAreThoseAgain) {
  EXPECT_NEAR(forecast(frameOf(1, 1, 2, 0, 2), planned(false, 8, 5)).period, 16, 1e-9);
}

TEST(Schedule, IsTheSameEveryTime) {
  std::vector<FrameCost> costs;
  for (int i = 0; i < 7; ++i) costs.push_back(frameOf(1 + 0.1 * i, 0.3, 2, 7 - i, 3, 1.7)[0]);
  const Plan plan = planned(true, 2, 3);
  const Schedule a = scheduleOf(costs, plan), b = scheduleOf(costs, plan);
  EXPECT_EQ(diagramText(a, 4), diagramText(b, 4));
  EXPECT_EQ(a.end, b.end);
}

TEST(Schedule, RemediesSayWhatMoreCoresGive) {
  const std::vector<FrameCost> costs = frameOf(0.1, 0.1, 0, 40, 1, 2);
  const std::vector<Remedy> remedies = remediesFor(costs, planned(true, 2));
  const auto at = std::ranges::find(remedies, "4 cores", &Remedy::what);
  ASSERT_NE(at, remedies.end());
  EXPECT_NEAR(at->then.period, 10, 0.5);
}

TEST(PlanDiagram, HasARowAThreadAndALineASwap) {
  const Schedule s = scheduleOf(frameOf(2, 3, 7, 4, 2), planned(true, 4, 2));
  const std::string text = diagramText(s, 3), svg = diagramSvg(s, 3, "a < b");
  for (const std::string& row : s.rows) {
    EXPECT_NE(text.find(row), std::string::npos);
    EXPECT_NE(svg.find(">" + row + "<"), std::string::npos);
  }
  EXPECT_NE(svg.find("a &lt; b"), std::string::npos);
  EXPECT_NE(svg.find("swap "), std::string::npos);
}

TEST(PlanCosts, AreReadAsTheyWereWritten) {
  ShowCosts costs;
  costs.show = "a.evs", costs.size = "8x8", costs.walls = {"x", "y"};
  costs.frames = frameOf(1.5, 0.25, 3, 4, 2, 1.75);
  costs.frames[0].walls[1].cullBesideDraw = 0.125;
  const Result<ShowCosts> read = readCosts("{\"costs\": " + toJson(costs) + "}", "f.json");
  ASSERT_TRUE(read);
  EXPECT_EQ(toJson(read.value()), toJson(costs));
}

TEST(PlanCosts, SayWhatIsWrongWithAFile) {
  const auto messageOf = [](const std::string& text) {
    const Result<ShowCosts> read = readCosts(text, "f.json");
    return read ? std::string() : read.error().message;
  };
  EXPECT_NE(messageOf("{").find("cannot be read"), std::string::npos);
  EXPECT_NE(messageOf("{}").find("has no \"format\""), std::string::npos);
  ShowCosts costs;
  costs.walls = {"x"};
  costs.frames = frameOf(-1, 0, 0);
  EXPECT_NE(messageOf(toJson(costs)).find("\"app\" is -1"), std::string::npos);
  costs.frames = frameOf(1, 0, 0, 0, 2);
  EXPECT_NE(messageOf(toJson(costs)).find("not as many walls"), std::string::npos);
  costs.frames.clear();
  EXPECT_NE(messageOf(toJson(costs)).find("no frames"), std::string::npos);
}

TEST(PlanCosts, WhereTheRasterisersThreadsGotNoProcessorThatIsSaid) {
  plan::FrameCost frame;
  frame.walls.push_back({0.1, {{0.4, 10, 1.9}}});
  EXPECT_FALSE(plan::wasStarved({frame}));
  frame.walls[0].pictures[0].atOnce = 0.06;
  EXPECT_TRUE(plan::wasStarved({frame, frame}));
  frame.walls[0].pictures[0].raster = 0.1;
  EXPECT_FALSE(plan::wasStarved({frame})) << "so little says nothing";
}

TEST(PlanCosts, WhatIsPlannedWithIsUndisturbed) {
  std::map<std::uint64_t, plan::FrameCost> run;
  for (std::uint64_t n = 0; n < 20; ++n) {
    plan::FrameCost frame;
    frame.walls.push_back({0.1, {{0.4, 10, n < 15 ? 0.7 : 1.9}}});
    run[n] = frame;
  }
  for (const plan::FrameCost& frame : plan::plannedCosts({run}))
    EXPECT_EQ(frame.walls[0].pictures[0].atOnce, 1.9);
}

}  // namespace
}  // namespace stadion::plan
