#pragma once
/// The values of one axis of a device inside a frame.
///
/// Times    non-decreasing; the value changes evenly from knot to knot, and two knots of the same time are a
///          jump. Before the first knot it is that knot's value, after the last one likewise.
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
using AxisTrack = std::vector<AxisKnot>;

/// Returns the device's axis from `start` to `end`, the time of the sample. It is 0 for a device that is lost
/// or unknown. Never empty.
AxisTrack axisTrack(const InputSample& input, std::string_view device, std::size_t axis, Nanoseconds start,
                    Nanoseconds end);

/// Expects at least one knot.
double axisOn(const AxisTrack& track, Nanoseconds time, Limit limit);

}  // namespace stadion
