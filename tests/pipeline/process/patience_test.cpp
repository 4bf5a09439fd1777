#include "pipeline/process/patience.h"

#include <gtest/gtest.h>

namespace stadion::worker {
namespace {

/// Of a wall with ten frames a second [ms].
double limitAfter(const std::vector<double>& times) {
  Patience patience(10);
  for (const double ms : times) patience.took(Patience::Milliseconds(ms));
  return patience.limit() ? patience.limit()->count() : -1;
}

TEST(Patience, WhatIsUsualIsNotKnownAfterTwoFrames) {
  EXPECT_EQ(limitAfter({}), -1);
  EXPECT_EQ(limitAfter({20, 20}), -1);
}

TEST(Patience, AWallThatIsDoneWithinItsFrameMakesTheOthersMissOneAtMost) {
  EXPECT_EQ(limitAfter({20, 20, 20}), 150);
  EXPECT_EQ(limitAfter({99, 98, 97, 96, 95}), 150);
}

TEST(Patience, FramesThatWereLongSayNothing) {
  EXPECT_EQ(limitAfter({700, 30, 30, 900, 30}), 150);
  EXPECT_EQ(limitAfter({30, 700, 700, 30}), 150);
}

TEST(Patience, WhatTakesLongerFromNowOnIsWaitedForAgainSoon) {
  EXPECT_EQ(limitAfter({30, 30, 30, 30, 30, 400, 400}), 150);
  EXPECT_EQ(limitAfter({30, 30, 30, 30, 30, 400, 400, 400}), 600);
}

TEST(Patience, WhatTakesLessFromNowOnIsNotWaitedForAsBefore) {
  EXPECT_EQ(limitAfter({400, 400, 400, 400, 400, 30, 30, 30}), 150);
}

}  // namespace
}  // namespace stadion::worker
