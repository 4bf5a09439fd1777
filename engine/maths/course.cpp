#include "engine/maths/course.h"

#include "engine/maths/functions.h"

#include <algorithm>

namespace stadion {

Pose poseOn(const Course& course, Nanoseconds time, Limit limit) {
  const auto next = limit == Limit::After ? std::ranges::upper_bound(course, time, {}, &PoseKnot::time)
                                          : std::ranges::lower_bound(course, time, {}, &PoseKnot::time);
  if (next == course.begin()) return course.front().X;
  const PoseKnot& last = *(next - 1);
  if (next == course.end() || next->jump) return last.X;
  const double s = static_cast<double>(time - last.time) / static_cast<double>(next->time - last.time);
  return det::interpolate(last.X, next->X, s);
}

bool moves(const Course& course) {
  return std::ranges::any_of(course, [&](const PoseKnot& k) {
    return k.X.p != course.front().X.p || k.X.q.coeffs() != course.front().X.q.coeffs();
  });
}

bool jumpsAt(const Course& course, Nanoseconds time) {
  return std::ranges::any_of(course, [&](const PoseKnot& k) { return k.jump && k.time == time; });
}

}  // namespace stadion
