/// Numbers in the text of a wall file: what changes, and what stays.

#include "engine/hall_edit/wall_text.h"

#include <gtest/gtest.h>

namespace stadion {
namespace {

constexpr const char* kTwoProjectors = "# corner  pins\r\n"
                                       "unit cm\t# of all\n"
                                       "\n"
                                       "  projector left  screen pins pins 0,0  1.0 0 1 1\t0 1   # mine\r\n"
                                       "projector right screen s edge-left 0.10 at 0 0 1 # edge-left 3\n"
                                       "output left warp 0 0  1 0  1 1  0 1";

TEST(WallText, ChangesNumbersAndNothingElse) {
  WallText text(kTwoProjectors);
  EXPECT_EQ(text.text(), kTwoProjectors);
  const double pins[] = {0.0125, -0.25, 1, 0, 1, 1, 0, 1.5};
  const auto change = text.set("projector", "left", "pins", pins);
  ASSERT_TRUE(change);
  EXPECT_EQ(change->line, 3u);
  EXPECT_EQ(change->after, "  projector left  screen pins pins 0.0125,-0.25  1 0 1 1\t0 1.5   # mine\r");
  const double edge[] = {0.123456789};
  ASSERT_TRUE(text.set("projector", "right", "edge-left", edge));
  ASSERT_TRUE(text.set("output", "left", "warp", pins));
  EXPECT_EQ(text.text(), "# corner  pins\r\n"
                         "unit cm\t# of all\n"
                         "\n"
                         "  projector left  screen pins pins 0.0125,-0.25  1 0 1 1\t0 1.5   # mine\r\n"
                         "projector right screen s edge-left 0.123457 at 0 0 1 # edge-left 3\n"
                         "output left warp 0.0125 -0.25  1 0  1 1  0 1.5");
  text.undo(*change);
  EXPECT_NE(text.text().find("pins 0,0  1.0 0 1 1\t0 1   # mine\r\n"), std::string::npos);
  text.redo(*change);
  EXPECT_NE(text.text().find("0.0125,-0.25"), std::string::npos);
}

TEST(WallText, AddsAFieldBeforeTheComment) {
  WallText text("output a  monitor 1   # the left one\noutput b");
  const double warp[] = {0, 0, 1, 0, 1, 1, 0, 1};
  ASSERT_TRUE(text.set("output", "a", "warp", warp));
  ASSERT_TRUE(text.set("output", "b", "warp", warp));
  EXPECT_EQ(text.text(), "output a  monitor 1  warp 0 0  1 0  1 1  0 1   # the left one\n"
                         "output b  warp 0 0  1 0  1 1  0 1");
  EXPECT_FALSE(text.set("output", "c", "warp", warp));
}

TEST(WallText, LeavesALineAloneIfItsFieldHasOtherWords) {
  WallText text("projector p pins 0 0 1 0 more 1 0 1");
  const double pins[] = {0, 0, 1, 0, 1, 1, 0, 1};
  EXPECT_FALSE(text.set("projector", "p", "pins", pins));
}

TEST(WallText, WritesShortNumbers) {
  EXPECT_EQ(numberText(0.1), "0.1");
  EXPECT_EQ(numberText(-1e-9), "0");
  EXPECT_EQ(numberText(2), "2");
  EXPECT_EQ(numberText(1.0 / 3), "0.333333");
  EXPECT_EQ(asWritten(1.0 / 3), 0.333333);
}

}  // namespace
}  // namespace stadion
