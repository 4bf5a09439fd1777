#pragma once
/// A step for bodies that the air slows or turns within less than a step: a feather in water.
///
/// Method   linearly implicit Euler for velocity, attitude and angular momentum together, with differences
///          for derivatives: of first order, and stable however stiff (Hairer & Wanner, Solving Ordinary
///          Differential Equations II, ch. IV.7). Where nothing is stiff, coupledStep is far more exact.

#include "dynamics/motion/coupled_step.h"

namespace stadion {

/// As coupledStep; what acts at the ends is given as the mean through the step.
template <class F>
CoupledStep stiffStep(const F& push, double tau, const CoupledState& start, const Vec3& inertia, double h) {
  using Nine = Eigen::Matrix<double, 9, 1>;
  const Spin free = Spin::unsteered(start.q, start.L, inertia);
  const Vec3 inverse = inertia.cwiseInverse();
  const Quat own = free.orientation(h);
  const Vec3 spin = free.angularVelocity(h, own);
  const auto stateAt = [&](const Nine& x) {
    CoupledState s = start;
    s.v += x.segment<3>(0);
    s.L += x.segment<3>(6);
    s.q = det::expRotation(x.segment<3>(3)) * own;
    return s;
  };
  const auto rateAt = [&](const Nine& x) {
    const CoupledState s = stateAt(x);
    const Vec3 omega = s.q * inverse.cwiseProduct(s.q.conjugate() * s.L), w = x.segment<3>(3);
    const CoupledPush now = push(tau + h, s, omega);
    Nine rate;
    rate << now.a, rateOfTurn(w, omega - det::expRotation(w) * spin), now.torque;
    return rate;
  };
  constexpr double kDifference = 1e-6;
  Nine size;
  size << Vec3::Constant(1 + start.v.norm()), Vec3::Ones(),
      Vec3::Constant(start.L.norm() + inertia.maxCoeff());
  const Nine still = Nine::Zero(), rate = rateAt(still);
  Eigen::Matrix<double, 9, 9> system = Eigen::Matrix<double, 9, 9>::Identity();
  for (int i = 0; i < 9; ++i) {
    Nine x = still;
    x[i] = kDifference * size[i];
    system.col(i) -= h / x[i] * (rateAt(x) - rate);
  }
  Nine x = system.partialPivLu().solve(h * rate);
  constexpr double kMostTurn = 3;  // [rad]
  const double turn = x.segment<3>(3).norm();
  if (turn > kMostTurn) x.segment<3>(3) *= kMostTurn / turn;

  CoupledStep step;
  step.end = stateAt(x);
  step.end.p += 0.5 * h * (start.v + step.end.v);
  step.first = step.last = {x.segment<3>(0) / h, x.segment<3>(6) / h};
  return step;
}

}  // namespace stadion
