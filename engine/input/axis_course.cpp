#include "engine/input/axis_course.h"

#include <algorithm>

namespace stadion {

AxisCourse axisCourse(const InputSample& input, std::string_view device, std::size_t axis, Nanoseconds start,
                      Nanoseconds end) {
  const TrackerSample* t = input.find(device);
  if (!t || axis >= kTrackerAxes) return {{start, 0}};
  AxisCourse course;
  const double last = t->hasControls() ? double{t->axes[axis]} : 0;
  for (const ControlKnot& c : t->controls) course.push_back({c.time, double{c.axes[axis]}});
  if (course.empty()) course.push_back({start, last});
  course.push_back({end, last});
  return course;
}

double axisOn(const AxisCourse& course, Nanoseconds time, Limit limit) {
  const auto next = limit == Limit::After ? std::ranges::upper_bound(course, time, {}, &AxisKnot::time)
                                          : std::ranges::lower_bound(course, time, {}, &AxisKnot::time);
  if (next == course.begin()) return course.front().value;
  if (next == course.end()) return course.back().value;
  const AxisKnot& last = *(next - 1);
  const double s = static_cast<double>(time - last.time) / static_cast<double>(next->time - last.time);
  return last.value + s * (next->value - last.value);
}

}  // namespace stadion
