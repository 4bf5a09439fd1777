#pragma once
/// Velocities of bodies in lasting contact: all contact points of a set at once.
///
/// Method   projected Gauss-Seidel over points, each with its normal and a friction disc, warm started,
/// iterated until the
///          velocities stand still (small sets) or a cap is reached (piles).

#include "dynamics/impulse.h"

#include <cstdint>
#include <vector>

namespace stadion {

struct SolverContact {
  std::uint32_t a = 0, b = 0;                ///< indices of mobiles
  Vec3 x = Vec3::Zero(), n = Vec3::UnitZ();  ///< n from b to a
  double gap = 0;                            ///< [m]
  double restitution = 0, friction = 0;
  double floor = 0;          ///< normal velocity that the step must reach [m/s]
  double normalImpulse = 0;  ///< accumulated [N s]; the guess on entry
  Vec3 frictionImpulse = Vec3::Zero();
};

/// Raises every contact's normal velocity to its `floor`, with friction. Returns the iterations used.
int solveContacts(std::vector<Mobile>& mobiles, std::vector<SolverContact>& contacts);

}  // namespace stadion
