#pragma once
/// How a hand has moved lately, and with which velocity it lets go.
///
/// The velocity is the slope of the least-squares line through the last 80 ms of its way: of the positions,
/// and of the angles that it has turned, added up from knot to knot (so that a fast spin is no slow one
/// backwards; within one step it is taken to turn less than half a turn). The way between the knots is
/// straight and counts by the time that it takes, so more knots on a straight way change nothing: frames
/// leave no trace in a throw.
///
/// Frames, units  poses X_WT; metres, seconds, radians.
/// Threads        a plain value.

#include "engine/maths/pose_track.h"

namespace stadion {

class HandMotion {
public:
  static constexpr Nanoseconds kWindow = 80'000'000;  ///< [ns]

  struct Velocity {
    Vec3 v = Vec3::Zero();      ///< velocity of the hand's origin [m/s]
    Vec3 omega = Vec3::Zero();  ///< in World [rad/s]
  };

  /// Places the hand there without a motion: the way to this pose does not count.
  void put(Nanoseconds time, const Pose& X_WT);
  /// Moves to that place, straight. Expects a later time than the last.
  void go(Nanoseconds time, const Pose& X_WT);

  /// Zero while its way has no length in time.
  Velocity velocity() const;
  /// Where it is. Expects that it has been put somewhere.
  const Pose& now() const { return way_.back().X; }
  const PoseTrack& way() const { return way_; }  ///< all that counts

  template <class Self, class Fields>
  static void fields(Self& h, Fields& f) {
    f("way", h.way_);
  }

private:
  PoseTrack way_;
};

}  // namespace stadion
