#pragma once
/// A motion inside a frame: straight ways and even turns between knots, and jumps.
///
/// Times    non-decreasing. Before the first knot it is at that knot's pose, after the last one likewise.
/// Frames   given by the owner; all knots of a pose track are in the same one.

#include "engine/base/time_signature.h"
#include "engine/maths/maths.h"

#include <vector>

namespace stadion {

/// Rotation and origin of a placement, its scale left out; of skewed axes, forward (+Y) counts first.
Pose poseOf(const Affine& X);
/// The lengths of a placement's axes.
Vec3 scaleOf(const Affine& X);
/// A placement at X with the scale of `like`.
Affine withScale(const Pose& X, const Affine& like);

struct PoseKnot {
  Nanoseconds time = 0;  ///< show time [ns]
  Pose X;
  bool jump = false;  ///< a jump: before `time` the pose is that of the knot before, from then on it is X

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

/// The side of a jump at exactly the requested time.
enum class Limit { Before, After };

/// Expects at least one knot.
Pose poseOn(const PoseTrack& track, Nanoseconds time, Limit limit);

/// Returns true if it is ever at another place than at first.
bool moves(const PoseTrack& track);

/// Returns true if it jumps at exactly `time`.
bool jumpsAt(const PoseTrack& track, Nanoseconds time);

}  // namespace stadion
