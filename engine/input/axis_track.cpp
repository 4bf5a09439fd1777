#include "engine/input/axis_track.h"

#include <algorithm>

namespace stadion {

AxisTrack axisTrack(const InputSample& input, std::string_view device, std::size_t axis, Nanoseconds start,
                    Nanoseconds end) {
  const TrackerSample* t = input.find(device);
  if (!t || axis >= kTrackerAxes) return {{start, 0}};
  AxisTrack track;
  const double last = t->hasControls() ? double{t->axes[axis]} : 0;
  for (const ControlKnot& c : t->controls) track.push_back({c.time, double{c.axes[axis]}});
  if (track.empty()) track.push_back({start, last});
  track.push_back({end, last});
  return track;
}

double axisOn(const AxisTrack& track, Nanoseconds time, Limit limit) {
  const auto next = limit == Limit::After ? std::ranges::upper_bound(track, time, {}, &AxisKnot::time)
                                          : std::ranges::lower_bound(track, time, {}, &AxisKnot::time);
  if (next == track.begin()) return track.front().value;
  if (next == track.end()) return track.back().value;
  const AxisKnot& last = *(next - 1);
  const double s = static_cast<double>(time - last.time) / static_cast<double>(next->time - last.time);
  return last.value + s * (next->value - last.value);
}

}  // namespace stadion
