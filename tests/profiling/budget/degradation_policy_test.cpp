/// Which nodes give up what, and when it comes back, for costs that are made up frame by frame.

#include "profiling/budget/degradation_policy.h"

#include "profiling/budget/stress_filter.h"

#include <functional>
#include <gtest/gtest.h>
#include <random>

namespace stadion {
namespace {

using enum DegradationStep;

/// A show that plays a node's cost and takes up what is decided two frames later, as a live show does.
struct Play {
  explicit Play(std::vector<DegradationStep> gives, double budget = 1)
      : ladder(std::move(gives)), policy({budget, 60}, savingsOf(ladder)) {}

  std::vector<DegradationStep> ladder;
  DegradationPolicy policy;
  std::uint64_t frame = 0;
  struct Change {
    std::uint64_t frame;
    std::uint32_t level;
  };
  std::vector<Change> changes;
  std::uint32_t level = 0, wanted = 0, wantedBefore = 0;

  /// `cost` of a frame, if nothing is given up; what is given up saves what it is expected to.
  void frames(std::uint64_t count, const std::function<BudgetedCost(std::uint64_t frame)>& cost) {
    for (std::uint64_t n = 0; n < count; ++n, ++frame) {
      if (wantedBefore == wanted && wanted != level) {
        level = wanted;
        policy.applied(frame);
        changes.push_back({frame, level});
      }
      const NodeDegradation r = degradationAt(ladder, level);
      BudgetedCost c = cost(frame);
      if (r.rests || frame % (std::uint64_t{1} << r.pace) != 0) c.app = 0;
      if (r.hidden) c.drawn = 0;
      c.drawn /= r.lod;
      wantedBefore = wanted;
      wanted = policy.take(frame, c);
    }
  }
  void app(std::uint64_t count, double ms) {
    frames(count, [ms](std::uint64_t) { return BudgetedCost{ms, 0}; });
  }
  std::size_t changesSince(std::uint64_t from) const {
    std::size_t count = 0;
    for (const Change& c : changes) count += c.frame >= from;
    return count;
  }
};

TEST(Ladder, GivesUpInTheAuthorsOrderALittleMoreAtEachLevel) {
  const std::vector<DegradationStep> ladder{Lod, Half, Hide};
  EXPECT_EQ(levelsOf(ladder), 6U);
  EXPECT_EQ(degradationAt(ladder, 0), NodeDegradation{});
  EXPECT_DOUBLE_EQ(degradationAt(ladder, 2).lod, 2.25);
  EXPECT_EQ(degradationAt(ladder, 3).pace, 0);
  EXPECT_EQ(degradationAt(ladder, 4).pace, 1);
  EXPECT_EQ(degradationAt(ladder, 5).pace, 2);
  EXPECT_FALSE(degradationAt(ladder, 5).hidden);
  EXPECT_TRUE(degradationAt(ladder, 6).hidden);
  EXPECT_EQ(degradationAt(ladder, 6), degradationAt(ladder, 99));
}

TEST(DegradationPolicy, GivesNothingUpWithinTheBudget) {
  Play p({Half, Rest});
  p.app(6000, 0.95);
  EXPECT_TRUE(p.changes.empty());
}

TEST(DegradationPolicy, ASingleSpikeChangesNothing) {
  Play p({Half, Rest});
  p.frames(6000, [](std::uint64_t f) { return BudgetedCost{f % 500 == 400 ? 60.0 : 0.5, 0}; });
  EXPECT_TRUE(p.changes.empty());
}

TEST(DegradationPolicy, AStallIsAnsweredWithinTenFramesByALevelThatFits) {
  Play p({Half, Rest});
  p.app(120, 0.3);
  p.app(10, 50);
  ASSERT_FALSE(p.changes.empty());
  EXPECT_LE(p.changes.front().frame, 130U);
  EXPECT_EQ(p.level, 3U);  // half and a quarter of 50 ms would not fit either: it rests
}

TEST(DegradationPolicy, ASlightOverrunIsAnsweredByTheFirstLevelThatFits) {
  Play p({Half, Rest});
  p.app(120, 0.3);
  p.app(300, 1.6);
  EXPECT_EQ(p.changes.size(), 1U);
  EXPECT_EQ(p.level, 1U);
}

TEST(DegradationPolicy, ARampIsFollowedLevelByLevel) {
  Play p({Half, Rest});
  const auto ramp = [](std::uint64_t f) { return BudgetedCost{0.5 + 0.001 * static_cast<double>(f), 0}; };
  p.frames(1000, ramp);
  EXPECT_EQ(p.level, 1U);
  p.frames(1500, ramp);  // from 1.5 to 3 ms
  EXPECT_EQ(p.level, 2U);
  EXPECT_LE(p.changes.size(), 8U);
}

TEST(DegradationPolicy, RecoversWhenTheStallIsOverAndStaysQuietForTenSeconds) {
  Play p({Half, Rest});
  p.app(120, 0.3);
  p.app(180, 50);
  p.app(540, 0.3);
  EXPECT_EQ(p.level, 0U);
  const std::uint64_t now = p.frame;
  p.app(600, 0.3);
  EXPECT_EQ(p.changesSince(now), 0U);
}

TEST(DegradationPolicy, WhatStaysTooDearIsTriedLessAndLessOften) {
  Play p({Half, Rest});
  p.app(120, 0.3);
  p.app(60 * 60, 50);
  std::vector<std::uint64_t> tries;
  for (const Play::Change& c : p.changes)
    if (c.level < 3) tries.push_back(c.frame);
  ASSERT_GE(tries.size(), 4U);
  EXPECT_LE(tries.size(), 8U);  // within a minute
  for (std::size_t i = 2; i < tries.size(); ++i)
    EXPECT_GT(tries[i] - tries[i - 1], tries[i - 1] - tries[i - 2]);
}

TEST(DegradationPolicy, NoiseAroundTheBudgetDoesNotMakeItOscillate) {
  Play p({Half, Rest});
  std::mt19937 random(7);
  std::normal_distribution<double> noise(0, 0.15);
  p.frames(60 * 120, [&](std::uint64_t) { return BudgetedCost{std::max(0.0, 1.15 + noise(random)), 0}; });
  // Two minutes: once down, and a few tries in vain.
  EXPECT_GE(p.changes.size(), 1U);
  EXPECT_LE(p.changes.size(), 14U);
  EXPECT_EQ(p.changes.front().level, 1U);
}

TEST(DegradationPolicy, DetailIsKeptWhereTheCostIsInApp) {
  Play p({Lod, Half});
  p.app(120, 0.3);
  p.app(60, 1.7);
  EXPECT_EQ(p.level, 4U);  // the levels of lod save nothing of App; they come first all the same
  EXPECT_EQ(p.changes.size(), 1U);
}

TEST(DegradationPolicy, WhatIsDrawnIsAnsweredByDetailAlone) {
  Play p({Lod, Hide});
  p.frames(120, [](std::uint64_t) { return BudgetedCost{0.1, 0.5}; });
  p.frames(300, [](std::uint64_t) { return BudgetedCost{0.1, 1.4}; });
  EXPECT_GE(p.level, 1U);
  EXPECT_LE(p.level, 3U);
}

TEST(DegradationPolicy, GivesNothingUpThatWouldNotHelp) {
  Play p({Lod, Hide});
  p.app(600, 5);
  EXPECT_TRUE(p.changes.empty());
}

TEST(StressFilter, IsPerformersFilterInQuarterOctaves) {
  StressFilter s({1, 0.7, 0.95, 0.1, 4});
  for (int i = 0; i < 3; ++i) s.take(0.8);  // within the band nothing happens
  EXPECT_EQ(s.stress(), 1);
  s.take(1.2);
  EXPECT_DOUBLE_EQ(s.stress(), 1.12);
  EXPECT_EQ(s.level(), 1U);
  for (int i = 0; i < 100; ++i) s.take(1.2);
  EXPECT_EQ(s.stress(), 4);
  EXPECT_EQ(s.level(), 8U);
  EXPECT_TRUE(s.exhausted());
  for (int i = 0; i < 3; ++i) s.take(0.5);
  EXPECT_DOUBLE_EQ(s.stress(), 3.85);
  for (int i = 0; i < 200; ++i) s.take(0.5);
  EXPECT_EQ(s.stress(), 1);
  EXPECT_EQ(s.level(), 0U);
}

TEST(StressFilter, DoesNotFlickerBetweenTwoLevels) {
  StressFilter s({1, 0.7, 0.95, 0.01, 4});
  std::uint32_t changes = 0, before = 0;
  for (int i = 0; i < 2000; ++i) {
    s.take(i % 2 == 0 ? 1.0 : 0.69);
    changes += s.level() != before, before = s.level();
  }
  EXPECT_LE(changes, 8U);
}

}  // namespace
}  // namespace stadion
