/// How the walls are drawn: as asked for, else as measured on this machine, else by the rule.

#include "show/player/drawing_plan.h"
#include "tests/programs/program.h"

#include <gtest/gtest.h>

namespace stadion {
namespace {

constexpr DrawSetting kThreads{false, 2, false}, kThreadsPinned{false, 1, true}, kProcesses{true, 0, true},
    kProcessesWithThreads{true, 2, false};

KnownMachine calibrated() {
  MachineCalibration m;
  m.when = "2026-11-23 05:01 UTC";
  m.rooms = {{4,
              800,
              600,
              "full",
              {{kThreads, 12, 130, 3},
               {kThreadsPinned, 12.2, 120, 3},
               {kProcesses, 17.5, 108, 4},
               {kProcessesWithThreads, 16, 112, 2}}}};
  return {2, m};
}

DrawingNeeds four() {
  DrawingNeeds needs;
  needs.walls = 4;
  return needs;
}

TEST(DrawingPlan, TakesWhatWasMeasuredToBeFastest) {
  const DrawingPlan plan(four(), calibrated());
  EXPECT_EQ(plan.setting(), kProcesses);
  EXPECT_TRUE(has(plan.why(), "calibrated 2026-11-23 05:01 UTC")) << plan.why();
  EXPECT_TRUE(has(plan.why(), "17.5 frames/s with 4 walls, by threads 12.")) << plan.why();
}

TEST(DrawingPlan, GivesThisProgramTheThreadsThatAreBestWhereItDrawsItself) {
  EXPECT_EQ(DrawingPlan(four(), calibrated()).rasteriserThreadsHere(), 1u);
  EXPECT_EQ(DrawingPlan(four(), {6, {}}).rasteriserThreadsHere(), 6u);
}

TEST(DrawingPlan, WithoutACalibrationIsTheRuleAndSaysHowToHaveOne) {
  const DrawingPlan plan(four(), {2, {}});
  EXPECT_EQ(plan.setting(), kThreads);
  EXPECT_TRUE(has(plan.why(), "stadion calibrate")) << plan.why();
}

TEST(DrawingPlan, OfARoomUnlikeThoseThatWereMeasuredIsTheRule) {
  DrawingNeeds one = four();
  one.walls = 1;
  const DrawingPlan plan(one, calibrated());
  EXPECT_EQ(plan.setting(), kThreads);
  EXPECT_TRUE(has(plan.why(), "no room like this one")) << plan.why();
}

TEST(DrawingPlan, DoesWhatIsAskedForAndTakesTheRestFromWhatWasMeasured) {
  DrawingNeeds needs = four();
  needs.wishes.processes = false;
  EXPECT_EQ(DrawingPlan(needs, calibrated()).setting(), kThreadsPinned);
  needs.wishes.pinned = false;
  EXPECT_EQ(DrawingPlan(needs, calibrated()).setting(), kThreads);
  needs.wishes = {true, {}, false};
  EXPECT_EQ(DrawingPlan(needs, calibrated()).setting(), kProcessesWithThreads);
  needs.wishes = {{}, 2, {}};
  EXPECT_EQ(DrawingPlan(needs, calibrated()).setting(), kProcessesWithThreads);
}

TEST(DrawingPlan, DoesWhatIsAskedForEvenWithoutAMeasurement) {
  DrawingNeeds needs = four();
  needs.wishes = {true, 7, true};
  for (const KnownMachine& machine : {calibrated(), KnownMachine{2, {}}}) {
    const DrawingPlan plan(needs, machine);
    EXPECT_EQ(plan.setting(), (DrawSetting{true, 7, true}));
    EXPECT_FALSE(has(plan.why(), "17.5")) << plan.why();
  }
}

TEST(DrawingPlan, DrawsHereWhereItMustAndSaysWhy) {
  DrawingNeeds needs = four();
  needs.here = "somebody looks on";
  const DrawingPlan plan(needs, calibrated());
  EXPECT_EQ(plan.setting(), kThreadsPinned);
  EXPECT_TRUE(plan.why().starts_with("somebody looks on; calibrated")) << plan.why();
  DrawingPlan later(four(), calibrated());
  later.drawHere("it turned out so");
  EXPECT_EQ(later.setting(), kThreadsPinned);
  EXPECT_TRUE(later.why().starts_with("it turned out so; ")) << later.why();
}

TEST(DrawingPlan, TheCpuRendererDrawsAllWallsWithOnePoolUnlessProcessesAreAskedFor) {
  DrawingNeeds needs = four();
  needs.cpuThreads = 6;
  const DrawingPlan plan(needs, calibrated());
  EXPECT_FALSE(plan.setting().processes) << "the calibration is OpenGL's";
  EXPECT_EQ(plan.text(4), "6 threads of the CPU renderer for all walls");
  EXPECT_EQ(plan.why(), "all walls share one pool of threads");
  needs.wishes.pinned = true;
  EXPECT_FALSE(DrawingPlan(needs, calibrated()).setting().pinned);
  needs.wishes.processes = true;
  const DrawingPlan apart(needs, calibrated());
  EXPECT_TRUE(apart.setting().processes && apart.setting().pinned);
  EXPECT_EQ(apart.text(4), "4 processes, each with 1 thread of the CPU renderer, pinned");
  EXPECT_EQ(apart.why(), "processes were asked for");
}

}  // namespace
}  // namespace stadion
