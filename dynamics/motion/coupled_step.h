#pragma once
/// One step of a body whose place and attitude act on each other, as in air, with all that is between.
///
/// Method   Dormand and Prince's pair of orders 5 and 4 for (p, v, w, L): the attitude is a small turn w
///          beside the free motion of the body (Spin::unsteered), which is exact however fast it spins, and
///          so leaves only what the air does to the steps.
/// Frames   World. Torques are about the centre of mass.
/// Bits     the same on all machines.

#include "dynamics/maths/dormand_prince.h"
#include "dynamics/motion/arc.h"
#include "engine/maths/functions.h"

#include <algorithm>
#include <cmath>

namespace stadion {

struct CoupledState {
  Vec3 p = Vec3::Zero(), v = Vec3::Zero();
  Quat q = Quat::Identity();  ///< principal axes C to World
  Vec3 L = Vec3::Zero();      ///< [kg m2/s]
};

/// The acceleration and torque that act on a body.
struct CoupledPush {
  Vec3 a = Vec3::Zero();       ///< [m/s2]
  Vec3 torque = Vec3::Zero();  ///< [N m]
};

struct CoupledStep {
  CoupledState end;
  CoupledPush first, last;  ///< pushes at the start and the end of the step
  double error = 0;         ///< in multiples of what is allowed
};

/// Error that a step may add: 1e-9 m, 1e-8 m/s, 1e-9 rad and 1e-8 rad/s.
struct CoupledTolerance {
  static constexpr double kPlace = 1e-9, kSpeed = 1e-8, kTurn = 1e-9, kTurning = 1e-8;
  /// A greater turn beside the free motion would not be small.
  static constexpr double kMostTurn = 0.05;
};

/// h seconds from `tau` on; `push(tau, state, omega)` says what acts.
template <class F>
CoupledStep coupledStep(const F& push, double tau, const CoupledState& start, const Vec3& inertia, double h) {
  namespace pair = dormand_prince;
  struct Rate {
    Vec3 p, v, w, L;
  };
  const Spin free = Spin::unsteered(start.q, start.L, inertia);
  const Vec3 inverse = inertia.cwiseInverse();
  Rate k[7];
  CoupledStep step;
  Vec3 w;
  for (int i = 0; i < 7; ++i) {
    CoupledState& s = step.end;
    s = start;
    w.setZero();
    for (int j = 0; j < i; ++j) {
      const double share = h * pair::kWeights[i][j];
      s.p += share * k[j].p;
      s.v += share * k[j].v;
      w += share * k[j].w;
      s.L += share * k[j].L;
    }
    const Quat own = free.orientation(pair::kTimes[i] * h), turn = det::expRotation(w);
    s.q = turn * own;
    const Vec3 omega = s.q * inverse.cwiseProduct(s.q.conjugate() * s.L);
    const CoupledPush now = push(tau + pair::kTimes[i] * h, s, omega);
    k[i] = {s.v, now.a, rateOfTurn(w, omega - turn * free.angularVelocity(pair::kTimes[i] * h, own)),
            now.torque};
    if (i == 0) step.first = now;
    if (i == 6) step.last = now;
  }
  Rate e{Vec3::Zero(), Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
  for (int i = 0; i < 7; ++i) {
    const double share = h * pair::kError[i];
    e.p += share * k[i].p;
    e.v += share * k[i].v;
    e.w += share * k[i].w;
    e.L += share * k[i].L;
  }
  using Allowed = CoupledTolerance;
  step.error =
      std::max({e.p.norm() / Allowed::kPlace, e.v.norm() / Allowed::kSpeed, e.w.norm() / Allowed::kTurn,
                (step.end.q.conjugate() * e.L).cwiseProduct(inverse).norm() / Allowed::kTurning});
  if (!(step.error < 1e300) || !step.end.p.allFinite()) step.error = 1e300;
  if (!(w.norm() <= Allowed::kMostTurn)) step.error = std::max(step.error, 1e5);
  return step;
}

}  // namespace stadion
