#include "engine/input/one_euro_filter.h"

#include "engine/maths/angles.h"
#include "engine/maths/functions.h"

namespace stadion {
namespace {

constexpr double kSpeedCutoff = 10;  ///< [Hz]

/// How much of a step a low pass of this cutoff takes in dt.
double lowPass(double cutoff, double dt) {
  const double r = 2 * kPi * cutoff * dt;
  return r / (r + 1);
}

}  // namespace

double OneEuroFilter::share(double dt, double speed) const {
  return cutoff_ <= 0 ? 1 : lowPass(cutoff_ + beta_ * speed, dt);
}

Pose OneEuroFilter::pass(const Pose& measured, double dt) {
  if (!begun_ || !(dt > 0)) {
    v_ = w_ = Vec3::Zero();
    begun_ = true;
    return measured_ = X_ = measured;
  }
  const double s = lowPass(kSpeedCutoff, dt);
  v_ += s * ((measured.p - measured_.p) / dt - v_);
  w_ += s * (det::logRotation(measured.q * measured_.q.conjugate()) / dt - w_);
  measured_ = measured;
  X_.p += share(dt, v_.norm()) * (measured.p - X_.p);
  X_.q = det::slerp(X_.q, measured.q, share(dt, w_.norm())).normalized();
  return X_;
}

}  // namespace stadion
