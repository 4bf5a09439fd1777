#pragma once
/// A motion inside a frame: what lies between knots, and jumps.
///
/// Between  two knots the motion is straight and turns evenly, or is a curve of fourth degree through three
///          more poses (PoseCurve). At 20 rad/s and 2 ms such a curve misses a true circle by 1e-9 of its
///          radius, and straight motion by 2e-4.
/// Times    non-decreasing. Before the first knot it is at that knot's pose, after the last one likewise.
/// Frames   given by the owner; all knots of a pose track are in the same one.

#include "engine/base/time_signature.h"
#include "engine/maths/maths.h"

#include <array>
#include <optional>
#include <vector>

namespace stadion {

/// Rotation and origin of a placement, its scale left out; of skewed axes, forward (+Y) counts first.
Pose poseOf(const Affine& X);
/// The lengths of a placement's axes.
Vec3 scaleOf(const Affine& X);
/// A placement at X with the scale of `like`.
Affine withScale(const Pose& X, const Affine& like);

/// The poses at 1/4, 1/2 and 3/4 of the time between two knots.
using CurvePoses = std::array<Pose, 3>;

struct PoseKnot {
  Nanoseconds time = 0;  ///< show time [ns]
  Pose X;
  bool jump = false;  ///< a jump: before `time` the pose is that of the knot before, from then on it is X
  /// The motion from the knot before to this one; nothing: straight. Not part of the recorded state.
  std::optional<CurvePoses> between = std::nullopt;

  template <class Self, class Fields>
  static void fields(Self& k, Fields& f) {
    f("time", k.time), f("pose", k.X), f("jump", k.jump);
  }
  bool operator==(const PoseKnot& o) const {
    return time == o.time && X.p == o.X.p && X.q.coeffs() == o.X.q.coeffs() && jump == o.jump;
  }
};

using PoseTrack = std::vector<PoseKnot>;

/// Turning or curved ways are approximated by chords of this length, on a grid of show time [ns].
constexpr Nanoseconds kChord = 2'000'000;

/// The polynomials of fourth degree through five equidistant poses; s runs from 0 at the first to 1 at the
/// last.
struct PoseCurve {
  std::array<Vec3, 5> p;             ///< coefficients of the position
  std::array<Eigen::Vector4d, 5> q;  ///< of the quaternion (x, y, z, w), before it is brought to unit length

  PoseCurve(const Pose& first, const CurvePoses& between, const Pose& last);
  Pose at(double s) const;
  /// The angular velocity and its rate of change, with s as time.
  struct Turning {
    Vec3 omega, alpha;
  };
  Turning turningAt(double s) const;
};

/// A curve over a shorter time is taken as straight: whole nanoseconds are too coarse for its quarters [ns].
constexpr Nanoseconds kShortestCurve = 10'000;

/// A quarter of the time between two others, which may lie between two whole nanoseconds. Taken at the one
/// before, a velocity at the end of a frame would be off by 5e-6 of it.
struct QuarterTime {
  Nanoseconds time = 0;  ///< whole [ns]
  double part = 0;       ///< [ns] from there, below 1

  static QuarterTime of(Nanoseconds from, Nanoseconds to, std::size_t k) {
    const Nanoseconds quarters = (to - from) * static_cast<Nanoseconds>(k + 1);
    return {from + quarters / 4, 0.25 * static_cast<double>(quarters % 4)};
  }
  /// `at`: the pose at `time`; `next`: a nanosecond later.
  Pose between(const Pose& at, const Pose& next) const;
};

/// Returns the poses between two times of a motion; nothing if these are too near to each other.
template <class PoseAt>
std::optional<CurvePoses> poseBetween(Nanoseconds from, Nanoseconds to, PoseAt poseAt) {
  if (to - from < kShortestCurve) return {};
  CurvePoses poses;
  for (std::size_t k = 0; k < poses.size(); ++k) {
    const QuarterTime quarter = QuarterTime::of(from, to, k);
    poses[k] = poseAt(quarter.time);
    if (quarter.part > 0) poses[k] = quarter.between(poses[k], poseAt(quarter.time + 1));
  }
  return poses;
}

/// Returns true if some part of it is a curve.
bool bends(const PoseTrack& track);

/// The side of a jump at exactly the requested time.
enum class Limit { Before, After };

/// Expects at least one knot.
Pose poseOn(const PoseTrack& track, Nanoseconds time, Limit limit);

/// Returns true if it is ever at another place than at first.
bool moves(const PoseTrack& track);

/// Returns true if it jumps at exactly `time`.
bool jumpsAt(const PoseTrack& track, Nanoseconds time);

}  // namespace stadion
