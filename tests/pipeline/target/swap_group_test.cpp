/// Swap groups, with a driver that is a table of functions: no hardware that has them was at hand.

#include "pipeline/target/swap_group.h"

#include <gtest/gtest.h>

#include <fmt/format.h>

namespace stadion {
namespace {

using Calls = std::vector<std::string>;

/// Writes down what it is asked to do.
struct FakeDriver {
  Calls calls;
  std::uint32_t groups = 1, barriers = 1;
  unsigned long refusedWindow = 0;
  bool refusesBarrier = false, lies = false;

  SwapGroupFunctions functions() {
    SwapGroupFunctions f;
    f.extensions = [] { return std::string("GLX_ARB_multisample GLX_NV_swap_group GLX_EXT_swap_control"); };
    f.most = [this](std::uint32_t& g, std::uint32_t& b) {
      g = groups;
      b = barriers;
      return true;
    };
    f.join = [this](unsigned long window, std::uint32_t group) {
      calls.push_back(fmt::format("join {} {}", window, group));
      return window != refusedWindow;
    };
    f.bind = [this](std::uint32_t group, std::uint32_t barrier) {
      calls.push_back(fmt::format("bind {} {}", group, barrier));
      return !refusesBarrier;
    };
    f.query = [this](unsigned long, std::uint32_t& group, std::uint32_t&) {
      if (lies) group = 0;
      return true;
    };
    f.frameCount = [](std::uint32_t& count) {
      count = 4711;
      return true;
    };
    return f;
  }
};

TEST(SwapGroup, WindowsJoinTheBarrierFollowsAndBothAreLeftInReverse) {
  FakeDriver driver;
  {
    const auto group = SwapGroup::join(driver.functions(), {11, 12, 13}, true);
    ASSERT_TRUE(group) << group.error().message;
    EXPECT_TRUE(group.value()->hasBarrier());
    EXPECT_EQ(group.value()->frameCount(), 4711U);
    EXPECT_EQ(driver.calls, (Calls{"join 11 1", "join 12 1", "join 13 1", "bind 1 1"}));
    driver.calls.clear();
  }
  EXPECT_EQ(driver.calls, (Calls{"bind 1 0", "join 13 0", "join 12 0", "join 11 0"}));
}

TEST(SwapGroup, WithoutABarrierNoneIsTouched) {
  FakeDriver driver;
  driver.barriers = 0;
  { EXPECT_TRUE(SwapGroup::join(driver.functions(), {11, 12}, false)); }
  EXPECT_EQ(driver.calls, (Calls{"join 11 1", "join 12 1", "join 12 0", "join 11 0"}));
}

TEST(SwapGroup, ARefusedWindowLeavesNoOtherInTheGroup) {
  FakeDriver driver;
  driver.refusedWindow = 13;
  const auto group = SwapGroup::join(driver.functions(), {11, 12, 13}, true);
  ASSERT_FALSE(group);
  EXPECT_EQ(group.error().message, "the display driver refuses a window in swap group 1");
  EXPECT_EQ(driver.calls, (Calls{"join 11 1", "join 12 1", "join 13 1", "join 12 0", "join 11 0"}));
}

TEST(SwapGroup, ARefusedBarrierLeavesTheGroup) {
  FakeDriver driver;
  driver.refusesBarrier = true;
  EXPECT_FALSE(SwapGroup::join(driver.functions(), {11}, true));
  EXPECT_EQ(driver.calls, (Calls{"join 11 1", "bind 1 1", "join 11 0"}));
}

TEST(SwapGroup, ADriverThatDidSomethingElseIsNotBelieved) {
  FakeDriver driver;
  driver.lies = true;
  const auto group = SwapGroup::join(driver.functions(), {11}, false);
  ASSERT_FALSE(group);
  EXPECT_EQ(group.error().message, "the display driver put a window into swap group 0, barrier 0");
  EXPECT_EQ(driver.calls, (Calls{"join 11 1", "join 11 0"}));
}

TEST(SwapGroup, WhatTheDriverLacksIsToldAndNothingIsCalled) {
  FakeDriver driver;
  SwapGroupFunctions other = driver.functions();
  other.extensions = [] { return std::string("GLX_NV_swap_group_of_another_name"); };
  EXPECT_EQ(SwapGroup::join(other, {11}, false).error().message, "the display driver has no swap groups");
  SwapGroupFunctions half = driver.functions();
  half.bind = nullptr;
  EXPECT_FALSE(SwapGroup::join(half, {11}, false));
  EXPECT_FALSE(SwapGroup::join({}, {11}, false));
  driver.barriers = 0;
  EXPECT_EQ(SwapGroup::join(driver.functions(), {11}, true).error().message,
            "the display driver has no swap barrier (GLX_NV_swap_group, 1 group, 0 barriers)");
  driver.groups = 0;
  EXPECT_FALSE(SwapGroup::join(driver.functions(), {11}, false));
  EXPECT_EQ(driver.calls, Calls{});
}

TEST(SwapGroup, ADriverWithoutCounterCountsNothing) {
  FakeDriver driver;
  SwapGroupFunctions f = driver.functions();
  f.frameCount = nullptr;
  f.query = nullptr;
  const auto group = SwapGroup::join(f, {11}, false);
  ASSERT_TRUE(group);
  EXPECT_FALSE(group.value()->frameCount());
}

TEST(SwapGroup, WithoutADisplayThereAreNoFunctions) {
  EXPECT_FALSE(SwapGroupFunctions::ofDisplay(nullptr));
  EXPECT_FALSE(offersQuadBuffer(nullptr));
}

}  // namespace
}  // namespace stadion
