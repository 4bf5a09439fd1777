#include "engine/input/axis_track.h"

#include <gtest/gtest.h>

namespace stadion {
namespace {

InputSample padAt(float last, bool valid, std::vector<ControlKnot> controls) {
  TrackerSample t;
  t.name = "pad", t.axes[2] = last, t.valid = valid, t.controls = std::move(controls);
  return {100, {t}};
}

ControlKnot knot(Nanoseconds time, float value) {
  ControlKnot k;
  k.time = time, k.axes[2] = value;
  return k;
}

TEST(AxisTrack, GoesEvenlyBetweenItsKnotsAndJumpsBetweenTwoOfATime) {
  const InputSample input = padAt(-1, true, {knot(0, 0), knot(40, 1), knot(40, 0.5f)});
  const AxisTrack track = axisTrack(input, "pad", 2, 0, 100);
  EXPECT_EQ(axisOn(track, 10, Limit::After), 0.25);
  EXPECT_EQ(axisOn(track, 40, Limit::Before), 1);
  EXPECT_EQ(axisOn(track, 40, Limit::After), 0.5);
  EXPECT_EQ(axisOn(track, 60, Limit::Before), 0);
  EXPECT_EQ(axisOn(track, 200, Limit::After), -1);
}

TEST(AxisTrack, OfADeviceWithoutTimesItIsAsAtTheEnd) {
  EXPECT_EQ(axisOn(axisTrack(padAt(0.5f, true, {}), "pad", 2, 0, 100), 0, Limit::After), 0.5);
}

TEST(AxisTrack, OfALostOrUnknownDeviceItIsZero) {
  EXPECT_EQ(axisOn(axisTrack(padAt(1, false, {}), "pad", 2, 0, 100), 100, Limit::Before), 0);
  EXPECT_EQ(axisOn(axisTrack(padAt(1, true, {}), "wand", 2, 0, 100), 50, Limit::Before), 0);
}

}  // namespace
}  // namespace stadion
