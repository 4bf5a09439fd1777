#include "engine/maths/pose_track.h"

#include "engine/maths/functions.h"

#include <algorithm>
#include <cmath>

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

namespace {

/// Coefficients of the polynomial through values at s = 0, 1/4, 1/2, 3/4 and 1, by Newton's forward
/// differences.
template <class T>
std::array<T, 5> throughFive(const std::array<T, 5>& y) {
  std::array<T, 5> d = y;  // the differences of order k in d[k]
  for (std::size_t k = 1; k < 5; ++k)
    for (std::size_t i = 4; i >= k; --i) d[i] = T(d[i] - d[i - 1]);
  return {d[0], T(4 * (d[1] - d[2] / 2 + d[3] / 3 - d[4] / 4)),
          T(16 * (d[2] / 2 - d[3] / 2 + 11 * d[4] / 24)), T(64 * (d[3] / 6 - d[4] / 4)), T(256 * d[4] / 24)};
}

template <class T>
T valueAt(const std::array<T, 5>& c, double s) {
  return T(c[0] + s * (c[1] + s * (c[2] + s * (c[3] + s * c[4]))));
}

}  // namespace

Pose QuarterTime::between(const Pose& at, const Pose& next) const {
  return det::interpolate(at, next, part);
}

PoseCurve::PoseCurve(const Pose& first, const CurvePoses& between, const Pose& last) {
  const std::array<const Pose*, 5> X{&first, &between[0], &between[1], &between[2], &last};
  std::array<Vec3, 5> positions;
  std::array<Eigen::Vector4d, 5> turns;
  for (std::size_t i = 0; i < 5; ++i) {
    positions[i] = X[i]->p;
    turns[i] = X[i]->q.coeffs();
    if (i > 0 && turns[i].dot(turns[i - 1]) < 0) turns[i] = -turns[i];
  }
  p = throughFive(positions);
  q = throughFive(turns);
}

Pose PoseCurve::at(double s) const {
  const Eigen::Vector4d x = valueAt(q, s);
  return {valueAt(p, s), Quat(x / std::sqrt(x.squaredNorm()))};
}

// With the quaternion Q of any length and its derivatives Q', Q'': omega is the vector part of 2 Q' Q* / |Q|^2,
// and its derivative follows by the quotient rule; Q' Q'* is real.
PoseCurve::Turning PoseCurve::turningAt(double s) const {
  const Eigen::Vector4d x = valueAt(q, s), d = q[1] + s * (2 * q[2] + s * (3 * q[3] + s * 4 * q[4])),
                        dd = 2 * q[2] + s * (6 * q[3] + s * 12 * q[4]);
  const Quat back = Quat(x).conjugate();
  const double square = x.squaredNorm();
  const Vec3 omega = 2 * (Quat(d) * back).vec() / square;
  return {omega, 2 * (Quat(dd) * back).vec() / square - omega * (2 * x.dot(d) / square)};
}

Pose poseOn(const PoseTrack& track, Nanoseconds time, Limit limit) {
  const auto next = limit == Limit::After ? std::ranges::upper_bound(track, time, {}, &PoseKnot::time)
                                          : std::ranges::lower_bound(track, time, {}, &PoseKnot::time);
  if (next == track.begin()) return track.front().X;
  const PoseKnot& last = *(next - 1);
  if (next == track.end() || next->jump) return last.X;
  const double s = static_cast<double>(time - last.time) / static_cast<double>(next->time - last.time);
  return next->between ? PoseCurve(last.X, *next->between, next->X).at(s)
                       : det::interpolate(last.X, next->X, s);
}

bool bends(const PoseTrack& track) {
  return std::ranges::any_of(track, [](const PoseKnot& k) { return k.between.has_value(); });
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
