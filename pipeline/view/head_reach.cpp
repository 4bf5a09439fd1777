#include "pipeline/view/head_reach.h"

#include "engine/maths/functions.h"

#include <algorithm>
#include <cmath>

namespace stadion {

// An eye is half the separation from the middle, and a turn takes it no farther than its arc is long.
double HeadReach::ofEyes(double separation) const {
  constexpr double kRoundingOfPlanes = 1e-6;  // of the planes that follow from it
  if (metres <= 0 && radians <= 0) return 0;
  return metres + 0.5 * std::abs(separation) * std::min(radians, 2.0) + kRoundingOfPlanes;
}

Pose HeadReach::within(const Pose& from, const Pose& to) const {
  Pose X = to;
  const Vec3 way = to.p - from.p;
  if (const double far = way.norm(); far > metres) X.p = from.p + metres / far * way;
  const Vec3 turn = det::logRotation(to.q * from.q.conjugate());
  if (const double angle = turn.norm(); angle > radians)
    X.q = (det::expRotation(radians / angle * turn) * from.q).normalized();
  return X;
}

}  // namespace stadion
