#pragma once
/// Smooths a trembling tracker: strongly while it is still, hardly while it moves fast, when lag would be
/// noticed.
///
/// The one-euro filter (Casiez, Roussel, Vogel 2012): a first-order low pass with the cutoff c + beta *
/// speed. The speed is itself smoothed, at 10 Hz. Position and orientation have a filter each.
///
/// Units    seconds, metres, radians, Hz.
/// Threads  plain value.

#include "engine/maths/maths.h"

namespace stadion {

class OneEuroFilter {
public:
  /// cutoff 0 lets everything through as it is.
  OneEuroFilter(double cutoff, double beta) : cutoff_(cutoff), beta_(beta) {}

  void reset() { begun_ = false; }
  /// The next measurement, dt [s] after the one before; dt > 0 but for the first.
  Pose pass(const Pose& measured, double dt);
  const Vec3& velocity() const { return v_; }         ///< [m/s], in the axes of the pose's outer frame
  const Vec3& angularVelocity() const { return w_; }  ///< [rad/s], likewise

private:
  double share(double dt, double speed) const;

  double cutoff_, beta_;
  bool begun_ = false;
  Pose measured_, X_;
  Vec3 v_ = Vec3::Zero(), w_ = Vec3::Zero();
};

}  // namespace stadion
