#include "dynamics/motion/hand_motion.h"

#include "engine/maths/functions.h"

#include <algorithm>

namespace stadion {

void HandMotion::put(Nanoseconds time, const Pose& X_WT) {
  way_.assign(1, {time, X_WT, false});
}

void HandMotion::go(Nanoseconds time, const Pose& X_WT) {
  way_.push_back({time, X_WT, false});
  // The knot at or before the window's start is still needed.
  const auto inside = std::ranges::upper_bound(way_, time - kWindow, {}, &PoseKnot::time);
  if (inside - way_.begin() > 1) way_.erase(way_.begin(), inside - 1);
}

HandMotion::Velocity HandMotion::velocity() const {
  if (way_.size() < 2) return {};
  const PoseKnot& last = way_.back();
  const Nanoseconds start = std::max(way_.front().time, last.time - kWindow);
  // Over x in [-W, 0] seconds the line's slope is (int x y - m int y) / (W^3 / 12) with m = -W / 2. A product
  // of two straight lines is integrated exactly by Simpson's rule.
  const double window = toSeconds(last.time - start), mean = -0.5 * window;
  Velocity slope;
  Vec3 turned =
      Vec3::Zero();  // so far: the sum of all small turns, which does not wrap as an orientation does
  const auto add = [&](double x, const Vec3& p, const Vec3& angle, double weight) {
    slope.v += weight * (x - mean) * (p - last.X.p);
    slope.omega += weight * (x - mean) * angle;
  };
  for (std::size_t i = 1; i < way_.size(); ++i) {
    if (way_[i].time <= start) continue;
    const Nanoseconds from = std::max(way_[i - 1].time, start);
    const double x0 = toSeconds(from - last.time), x1 = toSeconds(way_[i].time - last.time), h = x1 - x0;
    const Pose X0 = poseOn(way_, from, Limit::After);
    const Vec3 turn = det::logRotation(way_[i].X.q * X0.q.conjugate());
    add(x0, X0.p, turned, h / 6);
    add(0.5 * (x0 + x1), 0.5 * (X0.p + way_[i].X.p), turned + 0.5 * turn, 4 * h / 6);
    turned += turn;
    add(x1, way_[i].X.p, turned, h / 6);
  }
  const double scale = 12 / (window * window * window);
  return {slope.v * scale, slope.omega * scale};
}

}  // namespace stadion
