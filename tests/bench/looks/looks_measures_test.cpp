/// The measures of `stadion bench looks` against known answers.

#include "bench/looks/disparity.h"
#include "bench/looks/picture_errors.h"

#include <gtest/gtest.h>

#include <cmath>

namespace stadion::bench {
namespace {

Picture grey(std::uint8_t value, std::uint32_t width = 10, std::uint32_t height = 10) {
  return Picture(width, height, value);
}

/// Smooth waves, drawn `by` pixels to the right of their places.
Picture waves(double by) {
  Picture p(160, 96);
  for (std::uint32_t y = 0; y < p.height; ++y)
    for (std::uint32_t x = 0; x < p.width; ++x) {
      const double at = x - by;
      const double value = 128 + 50 * std::sin(0.31 * at + 0.2 * y) + 40 * std::sin(0.53 * at - 0.1 * y);
      for (int c = 0; c < 3; ++c) p.at(x, y)[c] = static_cast<std::uint8_t>(std::lround(value));
    }
  return p;
}

TEST(LooksMeasures, EqualPicturesHaveNoError) {
  PictureErrors errors;
  errors.add(grey(100), grey(100));
  EXPECT_EQ(errors.mean(), 0);
  EXPECT_EQ(errors.quantile(0.99), 0);
  EXPECT_EQ(errors.most(), 0);
  EXPECT_EQ(errors.within(0), 1);
}

TEST(LooksMeasures, ErrorsOfKnownPixels) {
  // Of 300 channels two differ by 40 and three by 9: 99 % are 297.
  Picture picture = grey(100);
  picture.at(0, 0)[0] = 140, picture.at(3, 4)[2] = 60;
  for (int c = 0; c < 3; ++c) picture.at(9, 9)[c] = 109;
  picture.at(5, 5)[3] = 0;  // alpha does not count
  PictureErrors errors;
  errors.add(picture, grey(100));
  EXPECT_DOUBLE_EQ(errors.mean(), (2 * 40 + 3 * 9) / 300.0);
  EXPECT_EQ(errors.quantile(0.98), 0);
  EXPECT_EQ(errors.quantile(0.99), 9);
  EXPECT_EQ(errors.quantile(1), 40);
  EXPECT_EQ(errors.most(), 40);
  EXPECT_DOUBLE_EQ(errors.within(8), 295 / 300.0);
  EXPECT_DOUBLE_EQ(errors.within(9), 298 / 300.0);
}

TEST(LooksMeasures, ErrorsOfSeveralPicturesCountTogether) {
  PictureErrors errors;
  errors.add(grey(100), grey(100));
  errors.add(grey(100), grey(110));
  EXPECT_EQ(errors.mean(), 5);
  EXPECT_EQ(errors.within(8), 0.5);
}

TEST(LooksMeasures, OnlyAChangeThatTheReferenceDoesNotShareIsFlicker) {
  const Picture dark = grey(50), bright = grey(80), wrong = grey(60), wrongLater = grey(94);
  EXPECT_EQ(flicker({dark, bright}, {dark, bright}), 0);
  EXPECT_EQ(flicker({wrong, wrong}, {dark, dark}), 0) << "an error that stays does not flicker";
  EXPECT_EQ(flicker({wrong, wrongLater}, {dark, bright}), 4);
}

TEST(LooksMeasures, AQuarterOfAPixelIsFound) {
  for (const double by : {0.0, 0.25, -0.25, 0.5, 1.25})
    for (std::uint32_t x : {32U, 64U, 96U}) {
      const auto shift = shiftOf({x, 32}, Brightness(waves(by)), Brightness(waves(0)));
      ASSERT_TRUE(shift) << by << " at " << x;
      EXPECT_NEAR(*shift, by, 0.02) << x;
    }
}

TEST(LooksMeasures, BlocksWithoutContrastAreLeftOut) {
  const Brightness flat(grey(100, 64, 64));
  EXPECT_FALSE(shiftOf({16, 16}, flat, flat));
}

TEST(LooksMeasures, DisparityIsWrongByTheDifferenceOfTheEyes) {
  const Picture left = waves(0), right = waves(3);
  EXPECT_NEAR(disparityErrors({left, right}, {left, right}).mean, 0, 0.01);
  const DisparityErrors one = disparityErrors({left, waves(3.25)}, {left, right});
  EXPECT_GT(one.blocks, 10u);
  EXPECT_NEAR(one.mean, 0.25, 0.02);
  EXPECT_NEAR(one.p95, 0.25, 0.03);
  const DisparityErrors both = disparityErrors({waves(0.25), waves(3.25)}, {left, right});
  EXPECT_NEAR(both.mean, 0, 0.02) << "both eyes are wrong alike: depth is right";
}

}  // namespace
}  // namespace stadion::bench
