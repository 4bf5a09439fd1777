#include "pipeline/device/live_trackers.h"

#include <gtest/gtest.h>

namespace stadion {
namespace {

TEST(LiveTrackers, ASilenceAndItsEndAreToldWithTheTrackersName) {
  constexpr Nanoseconds kMs = 1'000'000;
  Nanoseconds now = 1'000 * kMs, time = 0;
  std::vector<std::string> told;
  LiveTrackers trackers(
      standardRig(), [&](const std::string& line) { told.push_back(line); }, [&] { return now; });
  const auto frameAfter = [&](Nanoseconds step) {
    InputSample sample;
    now += step;
    trackers.sampleFrame(time, time + step, sample);
    time += step;
  };
  const auto head = [&] { trackers.pose("head", now, {Vec3(0, 0, 1.7), Quat::Identity()}); };
  head();
  frameAfter(10 * kMs);
  EXPECT_TRUE(told.empty());
  frameAfter(2000 * kMs);
  EXPECT_EQ(told, std::vector<std::string>{"tracker head is silent"});
  head();
  frameAfter(10 * kMs);
  ASSERT_EQ(told.size(), 2U);
  EXPECT_EQ(told[1], "tracker head is heard of again, after 2.0 s");
}

}  // namespace
}  // namespace stadion
