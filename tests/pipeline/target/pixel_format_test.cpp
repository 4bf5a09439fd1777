#include "pipeline/target/pixel_format.h"

#include <array>
#include <gtest/gtest.h>
#include <vector>

namespace stadion {
namespace {

std::vector<std::uint8_t> writtenAs(const PixelFormat& format, const std::vector<std::uint32_t>& pixels) {
  EXPECT_FALSE(whyNotWritten(format));
  std::vector<std::uint8_t> bytes(pixels.size() * format.bits / 8);
  PixelWriter(format).write(pixels, bytes.data());
  return bytes;
}

using Bytes = std::vector<std::uint8_t>;

TEST(PixelFormat, WordsOfTheUsualVisualNeedNoConversion) {
  EXPECT_TRUE(PixelFormat{}.isPlain());
  EXPECT_EQ(writtenAs({}, {0xff123456}), (Bytes{0x56, 0x34, 0x12, 0xff}));
  EXPECT_FALSE((PixelFormat{32, 0xff, 0xff00, 0xff0000, true}.isPlain()));
  EXPECT_FALSE((PixelFormat{32, 0xff0000, 0xff00, 0xff, false}.isPlain()));
}

TEST(PixelFormat, ChannelsMayStandInAnyOrderOfBytes) {
  EXPECT_EQ(writtenAs({32, 0xff0000, 0xff00, 0xff, false}, {0xff123456}), (Bytes{0xff, 0x12, 0x34, 0x56}));
  EXPECT_EQ(writtenAs({32, 0xff, 0xff00, 0xff0000, true}, {0xff123456}), (Bytes{0x12, 0x34, 0x56, 0xff}));
  EXPECT_EQ(writtenAs({24, 0xff0000, 0xff00, 0xff, true}, {0xff123456, 0xffabcdef}),
            (Bytes{0x56, 0x34, 0x12, 0xef, 0xcd, 0xab}));
}

TEST(PixelFormat, FewerAndMoreBitsGetTheNearestValue) {
  const PixelFormat few{16, 0xf800, 0x7e0, 0x1f, true}, many{32, 0x3ff00000, 0xffc00, 0x3ff, true};
  EXPECT_EQ(writtenAs(few, {0xffffffff, 0xff000000}), (Bytes{0xff, 0xff, 0, 0}));
  EXPECT_EQ(writtenAs(few, {0xff840000}), (Bytes{0, 0x80})) << "132 of 255 is 16 of 31";
  EXPECT_EQ(writtenAs(many, {0xffffffff}), (Bytes{0xff, 0xff, 0xff, 0xff}));
  EXPECT_EQ(writtenAs(many, {0xff000080}), (Bytes{0x02, 0x02, 0, 0xc0})) << "128 of 255 is 514 of 1023";
}

TEST(PixelFormat, WhatCannotBeWrittenIsSaid) {
  EXPECT_TRUE(whyNotWritten({8, 0xe0, 0x1c, 0x3, true}));
  EXPECT_TRUE(whyNotWritten({32, 0, 0xff00, 0xff, true}));
  EXPECT_TRUE(whyNotWritten({32, 0xf0f000, 0xff00, 0xff, true}));
  EXPECT_TRUE(whyNotWritten({16, 0xff0000, 0xff00, 0xff, true}));
}

}  // namespace
}  // namespace stadion
