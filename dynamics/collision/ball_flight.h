#pragma once
/// A ball in free flight as a parabola, in the frame of something that stands still: when it comes near faces
/// there, and when it gets away from them. In closed form.

#include "dynamics/collision/touch.h"

#include <optional>

namespace stadion {

struct BallFlight {
  Vec3 p, v, a;  ///< position, velocity and acceleration of the ball's centre now [m, m/s, m/s2]
  double radius = 0;

  BallFlight seenFrom(const Pose& X) const {
    const Quat back = X.q.conjugate();
    return {back * (p - X.p), back * v, back * a, radius};
  }
  Vec3 at(double t) const { return p + t * (v + 0.5 * t * a); }
  Vec3 velocityAt(double t) const { return v + t * a; }

  /// Seconds until it is as near as its radius to the triangle's plane, from either side; 0 if it is already,
  /// infinity if it is not within `most`.
  double timeToPlane(const Triangle& t, double most) const;

  /// The box around it from s to t.
  Aabb around(double s, double t) const;

  struct Entry {
    double time = 0;   ///< time before which the ball does not touch [s]; infinity: never within `most`
    bool hit = false;  ///< the ball touches a face at that time
  };
  /// Into a box.
  Entry timeToBox(const BoxShape& box, double most) const;

  struct Stay {
    double seconds = 0;  ///< time for which the gap is at most `far` [s]
    /// True: after `seconds` the ball is `far` from the last face below it. False: the face or the search ended first.
    bool sure = false;
    std::int32_t triangle = -1;  ///< triangle of a mesh that was the last one below the ball; else -1
  };
  /// Over a plane.
  Stay stayNear(const Vec3& on, const Vec3& normal, double far) const;
  /// Over the face of a box that is below it.
  Stay stayNear(const BoxShape& box, double far) const;
  /// Over faces of a mesh, from `triangle` on and from neighbour to neighbour as it crosses their edges.
  Stay stayNear(const TriangleTree& tree, std::int32_t triangle, double far) const;
};

/// The flight of a ball about its own centre from tau on, in World, until its arc ends; nothing if it is not
/// that simple.
std::optional<BallFlight> flightOf(const Side& ball, double tau);

}  // namespace stadion
