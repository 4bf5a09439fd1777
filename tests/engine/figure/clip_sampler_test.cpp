#include "engine/figure/clip_sampler.h"
#include "tests/engine/figure/figures.h"

#include <gtest/gtest.h>

#include <cmath>

namespace stadion::test {
namespace {

const std::vector<float> kTimes{0.5f, 1.0f, 2.5f};

TEST(ClipSampler, ItIsLinearBetweenKeysAndHoldsThoseAtTheEnds) {
  const ClipChannel c =
      channel(0, ChannelTarget::Translation, Interpolation::Linear, kTimes, {1, 2, 3, 5, 2, -1, 5, 8, -1});
  const auto at = [&](double t) {
    const auto v = sampleChannel(c, t);
    return Vec3(v[0], v[1], v[2]);
  };
  EXPECT_EQ(at(-1), Vec3(1, 2, 3));
  EXPECT_EQ(at(0.5), Vec3(1, 2, 3));
  EXPECT_LT((at(0.75) - Vec3(3, 2, 1)).norm(), 1e-12);
  EXPECT_LT((at(1.6) - Vec3(5, 4.4, -1)).norm(), 1e-12);
  EXPECT_EQ(at(2.5), Vec3(5, 8, -1));
  EXPECT_EQ(at(99), Vec3(5, 8, -1));
}

TEST(ClipSampler, AStepHoldsUntilTheNextKey) {
  const ClipChannel c =
      channel(0, ChannelTarget::Scale, Interpolation::Step, kTimes, {1, 1, 1, 2, 2, 2, 3, 3, 3});
  for (const auto& [time, value] :
       {std::pair{0.0, 1.0}, {0.9999, 1.0}, {1.0, 2.0}, {2.4999, 2.0}, {2.5, 3.0}})
    EXPECT_EQ(sampleChannel(c, time)[0], value) << time;
}

/// Against the polynomial in the form of the standard, in long double.
TEST(ClipSampler, ACubicFollowsTheFormula) {
  RandomKeys random(7);
  const ClipChannel c =
      channel(0, ChannelTarget::Translation, Interpolation::Cubic, kTimes, random.many(27, -3, 3));
  for (int i = 0; i < 200; ++i) {
    const double t = 0.5 + i * 0.01;
    const std::size_t k = t < 1 ? 0 : 1;
    const long double d = (long double)kTimes[k + 1] - kTimes[k], s = (t - (long double)kTimes[k]) / d;
    for (std::size_t n = 0; n < 3; ++n) {
      const auto v = [&](std::size_t key, std::size_t part) {
        return (long double)c.values[(3 * key + part) * 3 + n];
      };
      const long double want =
          (2 * s * s * s - 3 * s * s + 1) * v(k, 1) + d * (s * s * s - 2 * s * s + s) * v(k, 2) +
          (-2 * s * s * s + 3 * s * s) * v(k + 1, 1) + d * (s * s * s - s * s) * v(k + 1, 0);
      EXPECT_NEAR(sampleChannel(c, t)[n], static_cast<double>(want), 1e-12) << t;
    }
  }
}

TEST(ClipSampler, RotationsTurnTheShortWayWithConstantAngularVelocity) {
  const double half = std::sqrt(0.5);
  const auto f = [](double v) { return static_cast<float>(v); };
  // From none to 90 degrees about z, the second key with the other sign.
  const ClipChannel c = channel(0, ChannelTarget::Rotation, Interpolation::Linear, {0, 2},
                                {0, 0, 0, 1, 0, 0, f(-half), f(-half)});
  for (const double t : {0.0, 0.3, 1.0, 1.7, 2.0}) {
    const auto v = sampleChannel(c, t);
    const double angle = 2 * std::acos(std::min(std::fabs(v[3]), 1.0));
    EXPECT_NEAR(angle, t / 2 * std::acos(0.0), 1e-7) << t;
    EXPECT_GE(v[2] * v[3], 0) << t;
    EXPECT_NEAR(v[0] * v[0] + v[1] * v[1] + v[2] * v[2] + v[3] * v[3], 1, 1e-15);
  }
}

TEST(ClipSampler, OneKeyAndTwoKeysAtOneTimeServe) {
  const ClipChannel one = channel(0, ChannelTarget::Translation, Interpolation::Linear, {1}, {4, 5, 6});
  for (const double t : {0.0, 1.0, 2.0}) EXPECT_EQ(sampleChannel(one, t)[1], 5) << t;
  const ClipChannel two =
      channel(0, ChannelTarget::Translation, Interpolation::Linear, {1, 1, 2}, {0, 0, 0, 9, 0, 0, 9, 0, 0});
  EXPECT_EQ(sampleChannel(two, 1)[0], 9);
  EXPECT_EQ(sampleChannel(two, 0.5)[0], 0);
}

}  // namespace
}  // namespace stadion::test
