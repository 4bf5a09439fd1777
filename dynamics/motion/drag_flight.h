#pragma once
/// Flight through a medium under a constant pull: dv/dt = g - c u - k |u| u with u = v - wind.
///
/// Method   Taylor series of the position about the start, from the recurrences of |u|^2 = u.u and |u| u
///          (Moore, Methods and Applications of Interval Analysis, 1979, ch. 3); the horizon is chosen by the
///          last terms.

#include "dynamics/motion/arc.h"
#include "dynamics/motion/force_field.h"

namespace stadion {

/// The push on a body that feels only constant pulls and one medium that is the same everywhere.
struct EvenPull {
  Vec3 pull = Vec3::Zero();  ///< [m/s2]
  Drag drag;
  /// At least the acceleration along each axis of a body that had this velocity up to `seconds` ago: drag
  /// only slows it.
  Vec3 accelerationBound(const Vec3& v, double seconds) const;
};

/// Sets the path; returns to what age it is exact to `tolerance` [m], `longest` at most [s]. 0: the body is
/// too near to standing in the air for a series.
double dragFlight(const Vec3& p, const Vec3& v, const Vec3& pull, const Drag& drag, double longest,
                  double tolerance, Path& path);

}  // namespace stadion
