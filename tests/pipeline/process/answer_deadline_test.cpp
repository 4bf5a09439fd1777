#include "pipeline/process/answer_deadline.h"

#include <gtest/gtest.h>

namespace stadion::wall_process {
namespace {

/// Of a wall with ten frames a second [ms].
double limitAfter(const std::vector<double>& times) {
  AnswerDeadline deadline(10);
  for (const double ms : times) deadline.took(AnswerDeadline::Milliseconds(ms));
  return deadline.limit() ? deadline.limit()->count() : -1;
}

TEST(AnswerDeadline, WhatIsUsualIsNotKnownAfterTwoFrames) {
  EXPECT_EQ(limitAfter({}), -1);
  EXPECT_EQ(limitAfter({20, 20}), -1);
}

TEST(AnswerDeadline, AWallThatIsDoneWithinItsFrameMakesTheOthersMissOneAtMost) {
  EXPECT_EQ(limitAfter({20, 20, 20}), 150);
  EXPECT_EQ(limitAfter({99, 98, 97, 96, 95}), 150);
}

TEST(AnswerDeadline, FramesThatWereLongSayNothing) {
  EXPECT_EQ(limitAfter({700, 30, 30, 900, 30}), 150);
  EXPECT_EQ(limitAfter({30, 700, 700, 30}), 150);
}

TEST(AnswerDeadline, WhatTakesLongerFromNowOnIsWaitedForAgainSoon) {
  EXPECT_EQ(limitAfter({30, 30, 30, 30, 30, 400, 400}), 150);
  EXPECT_EQ(limitAfter({30, 30, 30, 30, 30, 400, 400, 400}), 600);
}

TEST(AnswerDeadline, WhatTakesLessFromNowOnIsNotWaitedForAsBefore) {
  EXPECT_EQ(limitAfter({400, 400, 400, 400, 400, 30, 30, 30}), 150);
}

}  // namespace
}  // namespace stadion::wall_process
