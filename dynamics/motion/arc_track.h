#pragma once
/// How a body goes through a frame, as nodes see it that do not simulate it: the arcs that it follows, each
/// from an exact moment on.
///
/// Frames   C is at the centre of mass, along the principal axes; N is the node that goes along, the body's
///          own or one that it carries.
/// Units    metres, seconds; ages as in arc.h.
/// Threads  plain values.

#include "dynamics/motion/arc.h"
#include "dynamics/motion/instant.h"
#include "engine/maths/maths.h"
#include "engine/maths/pose_track.h"

#include <vector>

namespace stadion {

/// Position and velocity of a rigid frame at one moment.
struct Kinematics {
  Pose pose;              ///< X_WN
  Vec3 p = Vec3::Zero();  ///< the point that v belongs to: a body's centre of mass, a collider's origin
  Vec3 v = Vec3::Zero();
  Vec3 omega = Vec3::Zero();
  Vec3 velocityAt(const Vec3& x) const { return v + omega.cross(x - p); }
};

/// How wildly the points of a side can move until the end of the frame.
struct MotionBound {
  double speed = 0;         ///< bound of the speed of p [m/s]
  double acceleration = 0;  ///< bound of the acceleration of p [m/s2]
  double spin = 0;          ///< [rad/s]
  double spinChange = 0;    ///< [rad/s2]
  /// Returns a bound for a point r metres from p.
  double accelerationAt(double r) const { return acceleration + (spin * spin + spinChange) * r; }
  double speedAt(double r) const { return speed + spin * r; }
  /// Returns the bound for another point of the same body, `arm` metres from p.
  MotionBound seenFrom(double arm) const { return {speedAt(arm), accelerationAt(arm), spin, spinChange}; }
};

/// The bound of a centre of mass on `path`, whose body turns as `spin` says, between two ages of each.
inline MotionBound boundOf(const Path& path, double pathFrom, double pathTo, const Spin& spin,
                           double spinTo) {
  MotionBound b;
  b.acceleration = path.accelerationBound();
  b.speed = path.velocity(pathFrom).norm() + b.acceleration * (pathTo - pathFrom);
  b.spin = spin.speedBound(spinTo);
  b.spinChange = spin.kind == Spin::Kind::Driven    ? spin.alpha.norm()
                 : spin.kind == Spin::Kind::Uniform ? 0
                 : spin.kind == Spin::Kind::Steered ? spin.steeredChange()
                                                    : b.spin * b.spin;
  return b;
}

struct ArcPiece {
  Instant from;
  double pathAge = 0, spinAge = 0;  ///< ages of path and spin at `from` [s]
  Path path;                        ///< path of C
  Spin spin;                        ///< spin of C
  Pose X_CN;
  bool jump = false;  ///< the body was placed from outside
  double tau = 0;     ///< `from`, in seconds after a moment that the reader has chosen

  /// From X_WN on it goes straight and turns evenly.
  static ArcPiece straight(const Instant& from, const Pose& X_WN, const Vec3& v, const Vec3& omega);
  /// Goes along the curve for so many seconds.
  static ArcPiece curved(const Instant& from, double seconds, const PoseCurve& curve);
  /// Returns position and motion of N's origin.
  Kinematics at(double when) const;
  Pose poseAfter(double seconds) const {
    return Pose{path.position(pathAge + seconds), spin.orientation(spinAge + seconds)} * X_CN;
  }
  /// Returns a bound of the motion of N's origin.
  MotionBound boundOver(double start, double end) const;
  bool stands() const;
  bool straight() const;  ///< the body goes straight and does not turn
  /// The first whole nanosecond at which it holds.
  Nanoseconds begins() const { return from.ns + (from.rest > 0 ? 1 : 0); }
};

/// In the order of time; a part lasts until the next one.
using ArcTrack = std::vector<ArcPiece>;

/// Where it is at that time; before its first part, where that begins. Expects at least one part.
Pose poseOn(const ArcTrack& arcs, Nanoseconds time, Limit limit);
/// Returns true if the body is placed from outside at exactly `time`.
bool jumpsAt(const ArcTrack& arcs, Nanoseconds time);
/// The same motion as arcs. Velocities are the derivatives of its curves. Expects at least one knot; after the
/// last one it stands still.
ArcTrack arcsOf(const PoseTrack& track);
/// Adds the path as straight chords, up to `end`, for nodes that follow no arcs.
void addChords(const ArcTrack& arcs, Nanoseconds end, PoseTrack& track);

}  // namespace stadion
