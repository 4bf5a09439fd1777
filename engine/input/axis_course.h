#pragma once
/// How one axis of a device goes inside a frame.
///
/// Times    non-decreasing; it goes evenly from knot to knot, and two knots of the same time are a jump.
///          Before the first knot it is as that says, after the last one likewise.
/// Units    from -1 to 1.

#include "engine/input/input_sample.h"

#include <string_view>
#include <vector>

namespace stadion {

struct AxisKnot {
  Nanoseconds time = 0;  ///< show time [ns]
  double value = 0;

  bool operator==(const AxisKnot&) const = default;

  template <class Self, class Fields>
  static void fields(Self& k, Fields& f) {
    f("time", k.time), f("value", k.value);
  }
};
using AxisCourse = std::vector<AxisKnot>;

/// What the axis of the device says from `start` to `end`, the time of the sample. Of a device that is lost
/// or that nobody knows it is 0. Never empty.
AxisCourse axisCourse(const InputSample& input, std::string_view device, std::size_t axis, Nanoseconds start,
                      Nanoseconds end);

/// Expects at least one knot.
double axisOn(const AxisCourse& course, Nanoseconds time, Limit limit);

}  // namespace stadion
