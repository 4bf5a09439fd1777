#include "engine/input/head_forecast.h"

#include "engine/input/input_recorder.h"
#include "engine/input/tracker_feed.h"
#include "engine/maths/functions.h"
#include "tests/engine/asset/importing.h"

#include <gtest/gtest.h>

#include <cmath>

namespace stadion {
namespace {

constexpr Nanoseconds kMs = 1'000'000;

double angleBetween(const Quat& a, const Quat& b) {
  return det::logRotation(a * b.conjugate()).norm();
}

TEST(Forecast, WhatGoesAndTurnsEvenlyIsWhereItWillBe) {
  const Pose X{Vec3(1, 2, 1.7), det::fromEuler(0.1, 0.2, 0.3)};
  const Vec3 v(0.8, -0.6, 0.1), w(0.2, -0.1, 2);
  const Pose then = forecast(X, v, w, 0.05);
  EXPECT_NEAR((then.p - (X.p + 0.05 * v)).norm(), 0, 2e-4);
  EXPECT_NEAR(angleBetween(then.q, det::expRotation(0.05 * w) * X.q), 0, 2e-4);
  EXPECT_NEAR(then.q.norm(), 1, 1e-15);
}

TEST(Forecast, WhatTremblesStaysAlmostWhereItIs) {
  const Pose still = forecast({}, Vec3(0.003, 0, 0), Vec3(0, 0, 0.006), 0.1);
  EXPECT_LT(still.p.norm(), 0.02 * 0.003 * 0.1);
  EXPECT_LT(angleBetween(still.q, Quat::Identity()), 0.02 * 0.006 * 0.1);
  const Pose X{Vec3(1, 2, 3), det::fromEuler(0, 0, 1)};
  EXPECT_EQ(forecast(X, Vec3::Zero(), Vec3::Zero(), 0.1).p, X.p);
  EXPECT_EQ(forecast(X, Vec3(1, 0, 0), Vec3::Zero(), 0).p, X.p);
}

TEST(Forecast, NoHeadIsCarriedFasterOrLongerThanTheLimitsAllow) {
  const ForecastLimits limits;
  const Pose fast = forecast({}, Vec3(100, 0, 0), Vec3(0, 0, 100), 0.05, {}, limits);
  EXPECT_NEAR(fast.p.x(), 0.05 * limits.speed, 1e-9);
  EXPECT_NEAR(angleBetween(fast.q, Quat::Identity()), 0.05 * limits.turning, 1e-9);
  const Pose longest = forecast({}, Vec3(1, 0, 0), Vec3::Zero(), limits.longest, {}, limits);
  EXPECT_EQ(forecast({}, Vec3(1, 0, 0), Vec3::Zero(), 10, {}, limits).p, longest.p);
}

RigFile bareRig() {
  RigFile rig = standardRig();
  rig.cutoff = rig.beta = 0, rig.predict = 0.02;
  return rig;
}

/// A head that walks to the right at 1 m/s and turns to the left at 1 rad/s.
Pose walking(double seconds) {
  return {Vec3(seconds, 0, 1.7), det::expRotation(Vec3(0, 0, seconds))};
}

TEST(TrackerFeed, AHeadThatIsAimedIsToldAsItWillBe) {
  TrackerFeed feed(bareRig());
  for (int i = 0; i <= 400; ++i) feed.pose("head", i * 5 * kMs, walking(0.005 * i));
  InputSample sample;
  feed.setPrediction("head", 50 * kMs);
  feed.sampleFrame(2010 * kMs, 0, 16 * kMs, sample);
  EXPECT_NEAR(sample.find("head")->X_RT.p.x(), 2.060, 3e-4);
  EXPECT_NEAR(angleBetween(sample.find("head")->X_RT.q, walking(2.060).q), 0, 1e-3);
  EXPECT_EQ(sample.find("head")->measured, 2000 * kMs);
  EXPECT_EQ(sample.find("wand")->measured, 0);
  const auto soon = feed.predictedHead("head", 2010 * kMs, 20 * kMs);
  ASSERT_TRUE(soon);
  EXPECT_NEAR(soon->X_RH.p.x(), 2.030, 3e-4);
  EXPECT_EQ(soon->measured, 2000 * kMs);
  EXPECT_FALSE(feed.predictedHead("wand", 2010 * kMs, 0));
}

TEST(TrackerFeed, AHeadThatIsAimedDoesNotLagBehindForBeingSmoothed) {
  RigFile rig = bareRig();
  rig.cutoff = 4, rig.beta = 10;
  TrackerFeed feed(rig);
  for (int i = 0; i <= 400; ++i) feed.pose("head", i * 5 * kMs, walking(0.005 * i));
  const Pose truly = walking(2.040);
  const auto told = feed.predictedHead("head", 2000 * kMs, 40 * kMs),
             late = feed.predictedHead("head", 2000 * kMs, 0);
  EXPECT_NEAR((told->X_RH.p - truly.p).norm(), 0, 5e-4);
  EXPECT_NEAR(angleBetween(told->X_RH.q, truly.q), 0, 1e-3);
  EXPECT_GT((late->X_RH.p - walking(2).p).norm(), 5e-3) << "nothing is caught up with without being asked";
}

TEST(TrackerFeed, WhatWasForeseenIsInTheRecordAndTheReplayHasItToTheBit) {
  const test::TestFolder folder;
  const std::string path = folder.path() / "aimed.input";
  TrackerFeed feed(bareRig());
  std::vector<InputSample> live;
  {
    InputRecorder recorder(path, 60);
    Nanoseconds measured = 0;
    for (std::uint64_t n = 0; n < 300; ++n) {
      const TimeSignature now = signatureAt(n, 60);
      for (; measured <= now.time; measured += 7 * kMs) {
        const double t = toSeconds(measured);
        feed.pose("head", measured,
                  {Vec3(std::sin(3 * t), 0.4 * std::sin(9 * t), 1.7), det::fromEuler(0, 0, t)});
      }
      // As auto aims, from frame to frame; and now and then as it never does.
      feed.setPrediction("head", n % 50 == 49 ? 0 : static_cast<Nanoseconds>(40 + n % 7) * kMs);
      InputSample sample;
      feed.sampleFrame(now.time, now.time - now.step, now.time, sample);
      recorder.frame(now), recorder.record(sample);
      live.push_back(sample);
    }
    ASSERT_FALSE(recorder.commit());
  }
  Diagnostics findings;
  const auto log = loadInputLog(path, findings);
  ASSERT_TRUE(log);
  for (std::uint64_t n = 0; n < live.size(); ++n) {
    const TimeSignature now = signatureAt(n, 60);
    InputSample again;
    log->sampleFrame(now.time - now.step, now.time, again);
    ASSERT_EQ(again.trackers, live[n].trackers) << n;
    EXPECT_EQ(again.find("head")->measured, 0);
  }
}

}  // namespace
}  // namespace stadion
