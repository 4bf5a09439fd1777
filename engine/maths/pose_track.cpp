#include "engine/maths/pose_track.h"

#include "engine/maths/functions.h"

#include <algorithm>

namespace stadion {

Pose poseOf(const Affine& X) {
  const Vec3 y = X.linear().col(1).normalized();
  const Vec3 x = (X.linear().col(0) - y * y.dot(X.linear().col(0))).normalized();
  Mat3 R;
  R << x, y, x.cross(y);
  return {X.translation(), Quat(R).normalized()};
}

Vec3 scaleOf(const Affine& X) {
  return X.linear().colwise().norm().transpose();
}

Affine withScale(const Pose& X, const Affine& like) {
  Affine scaled = toAffine(X);
  scaled.linear() = scaled.linear() * scaleOf(like).asDiagonal();
  return scaled;
}

Pose poseOn(const PoseTrack& track, Nanoseconds time, Limit limit) {
  const auto next = limit == Limit::After ? std::ranges::upper_bound(track, time, {}, &PoseKnot::time)
                                          : std::ranges::lower_bound(track, time, {}, &PoseKnot::time);
  if (next == track.begin()) return track.front().X;
  const PoseKnot& last = *(next - 1);
  if (next == track.end() || next->jump) return last.X;
  const double s = static_cast<double>(time - last.time) / static_cast<double>(next->time - last.time);
  return det::interpolate(last.X, next->X, s);
}

bool moves(const PoseTrack& track) {
  return std::ranges::any_of(track, [&](const PoseKnot& k) {
    return k.X.p != track.front().X.p || k.X.q.coeffs() != track.front().X.q.coeffs();
  });
}

bool jumpsAt(const PoseTrack& track, Nanoseconds time) {
  return std::ranges::any_of(track, [&](const PoseKnot& k) { return k.jump && k.time == time; });
}

}  // namespace stadion
