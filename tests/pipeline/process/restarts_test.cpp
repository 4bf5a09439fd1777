#include "pipeline/process/restarts.h"

#include <gtest/gtest.h>

namespace stadion::wall_process {
namespace {

using Death = Restarts::Death;
constexpr Restarts::Clock::time_point kNow{std::chrono::seconds(1000)};

/// After how long the next one may be started.
std::chrono::milliseconds pauseOf(const Restarts& restarts) {
  std::chrono::milliseconds pause{0};
  while (!restarts.due(kNow + pause)) ++pause;
  return pause;
}

TEST(Restarts, TheFirstDeathIsAnsweredAtOnceAndToldOf) {
  Restarts restarts;
  EXPECT_EQ(restarts.died(kNow), Death::First);
  EXPECT_TRUE(restarts.due(kNow));
  EXPECT_TRUE(restarts.drew()) << "the wall is back with its first picture";
  EXPECT_FALSE(restarts.drew());
}

TEST(Restarts, PausesDoubleUpToTheLongestWhileProcessesDieTooSoon) {
  Restarts restarts;
  restarts.died(kNow);
  std::vector<std::int64_t> pauses;
  for (int i = 0; i < 12; ++i) {
    for (int frame = 0; frame < 5; ++frame) EXPECT_EQ(restarts.drew(), i == 0 && frame == 0);
    EXPECT_EQ(restarts.died(kNow), i == 0 ? Death::Second : Death::Further);
    pauses.push_back(pauseOf(restarts).count());
  }
  EXPECT_EQ(pauses, (std::vector<std::int64_t>{250, 500, 1000, 2000, 4000, 8000, 16000, 30000, 30000, 30000,
                                               30000, 30000}));
}

TEST(Restarts, OneThatDrawsLongEnoughIsForgiven) {
  Restarts restarts;
  for (int i = 0; i < 4; ++i) restarts.died(kNow);
  for (std::size_t frame = 1; frame <= Restarts::kSteady; ++frame)
    EXPECT_EQ(restarts.drew(), frame == Restarts::kSteady);
  EXPECT_EQ(restarts.died(kNow), Death::First);
  EXPECT_TRUE(restarts.due(kNow));
}

}  // namespace
}  // namespace stadion::wall_process
