#pragma once
/// Velocities of a heap of bodies: many contact points, a fixed number of sweeps.
///
/// Method   projected Gauss-Seidel over points in flat arrays, warm started. Points that overlap are pushed
/// apart by a velocity that moves the bodies but is taken from them again before the next step; points that
/// have yet to meet may close their gap and no more.
/// Energy   the sweeps take it away, but bodies go straight between steps, which may add some again: up to
/// 2.5e-4 of the whole in one frame, measured on a heap of a thousand balls.

#include "engine/maths/maths.h"

#include <cstdint>
#include <vector>

namespace stadion {

struct CrowdBody {
  Vec3 v = Vec3::Zero(), omega = Vec3::Zero();
  Vec3 p = Vec3::Zero();
  double inverseMass = 0;
  double roundInertia = 0;             ///< inverse, of balls; 0: see the next
  Mat3 inverseInertia = Mat3::Zero();  ///< in World, of others
  void apply(const Vec3& impulse, const Vec3& arm) {
    v += inverseMass * impulse;
    if (roundInertia > 0)
      omega += roundInertia * arm.cross(impulse);
    else if (inverseMass > 0)
      omega += inverseInertia * arm.cross(impulse);
  }
};

struct CrowdContact {
  std::uint32_t a = 0, b = 0;  ///< indices of bodies
  Vec3 n = Vec3::UnitZ();      ///< from b to a
  Vec3 armA = Vec3::Zero(), armB = Vec3::Zero();
  double gap = 0, friction = 0, restitution = 0, rolling = 0;
  Vec3 impulse = Vec3::Zero();  ///< on a, in World [N s]; the guess on entry
  std::uint64_t key = 0;
  // Set by the solver.
  double pressed = 0, normalMass = 0, tangentMass = 0, floor = 0, calm = 0;
};

/// `moved` become the velocities that carry the bodies through the step, `bodies` those they have after it.
void solveCrowd(std::vector<CrowdBody>& bodies, std::vector<CrowdContact>& contacts,
                const std::vector<Vec3>& pull, double h, std::vector<CrowdBody>& moved);

}  // namespace stadion
