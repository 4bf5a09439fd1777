#include "pipeline/output/output_colours.h"

#include "pipeline/picture/stereo.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <gtest/gtest.h>

namespace stadion {
namespace {

std::uint32_t pixelOf(std::uint32_t red, std::uint32_t green, std::uint32_t blue) {
  return red | green << 8 | blue << 16 | 0xff000000;
}

double lightOf(std::uint32_t value) {
  const double share = value / 255.0;
  return share <= 0.04045 ? share / 12.92 : std::pow((share + 0.055) / 1.055, 2.4);
}

double valueOf(double light) {
  return light <= 0.0031308 ? 12.92 * light : 1.055 * std::pow(light, 1 / 2.4) - 0.055;
}

template <class Check>
void forManyColours(const Check& check) {
  for (std::uint32_t red = 0; red < 256; red += 5)
    for (std::uint32_t green = 0; green < 256; green += 3)
      for (std::uint32_t blue = 0; blue < 256; blue += 17) check(red, green, blue);
}

TEST(OutputColours, TheRedOfAnAnaglyphIsTheLuminanceThatPicturesInFilesHave) {
  const AnaglyphRed red{OutputShape{}};
  forManyColours([&](std::uint32_t r, std::uint32_t g, std::uint32_t b) {
    const std::uint32_t pixel = pixelOf(r, g, b);
    Picture left(1, 1), right(1, 1);
    std::memcpy(left.rgba.data(), &pixel, sizeof pixel);
    const int inFile = compose(StereoLayout::Anaglyph, left, right).rgba[0];
    ASSERT_NEAR(red(pixel), inFile, 1) << r << " " << g << " " << b;
  });
  for (std::uint32_t v = 0; v < 256; ++v) EXPECT_EQ(red(pixelOf(v, v, v)), v);
}

TEST(OutputColours, GammaAndBrightnessOfAnAnaglyphActOnItsExactLuminance) {
  OutputShape shape;
  shape.gamma = {2.5, 1, 1}, shape.brightness = {0.6, 1, 1};
  const AnaglyphRed red(shape);
  forManyColours([&](std::uint32_t r, std::uint32_t g, std::uint32_t b) {
    const double light = 0.2126 * lightOf(r) + 0.7152 * lightOf(g) + 0.0722 * lightOf(b);
    const double wanted = 255 * std::pow(valueOf(light), 1 / 2.5) * channelGain(0.6);
    ASSERT_NEAR(red(pixelOf(r, g, b)), wanted, 0.501) << r << " " << g << " " << b;
  });
}

TEST(OutputColours, ADarkOutputIsBlack) {
  OutputShape shape;
  shape.brightness = {0, 0, 0};
  EXPECT_EQ(OutputColours(shape).changed(0xffffffff), 0xff000000);
  EXPECT_EQ(AnaglyphRed(shape)(0xffffffff), 0);
}

TEST(OutputColours, WithoutGammaAndBrightnessNothingChanges) {
  const OutputColours colours{OutputShape{}};
  EXPECT_FALSE(colours.changes());
  EXPECT_EQ(colours.changed(0xff123456), 0xff123456);
}

}  // namespace
}  // namespace stadion
