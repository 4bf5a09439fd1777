#include "dynamics/motion/body_flight.h"

#include <cmath>

namespace stadion {

MassProperties revolved(const MassProperties& mass, const BodyFlight& flight) {
  constexpr double kNearly = 0.02;
  const Mat3 R = (flight.q_NA.conjugate() * mass.axes).toRotationMatrix();
  const Mat3 inertia = R * mass.inertia.asDiagonal() * R.transpose();
  const double size = mass.inertia.maxCoeff();
  const auto apart = [&](int i) {
    return std::fabs(inertia((i + 1) % 3, (i + 1) % 3) - inertia((i + 2) % 3, (i + 2) % 3));
  };
  const int k = symmetryAxis(flight.model).value_or(apart(0) < apart(2) ? 0 : 2), i = (k + 1) % 3,
            j = (k + 2) % 3;
  const Mat3 off = inertia - Mat3(inertia.diagonal().asDiagonal());
  if (off.cwiseAbs().maxCoeff() > kNearly * size || apart(k) > kNearly * size) return mass;
  MassProperties round = mass;
  round.axes = flight.q_NA;
  round.inertia = inertia.diagonal();
  round.inertia[i] = round.inertia[j] = 0.5 * (inertia(i, i) + inertia(j, j));
  return round;
}

}  // namespace stadion
