#pragma once
/// Collision impulses at one point: Newton's restitution and Coulomb's friction. None adds energy.
///
/// Formula  K = sum (1/m + [r]^T I^-1 [r]). The impulse that stops the slip and reverses the approach is
///          K^-1 du. Outside the friction cone, its tangential part is mu times its normal part, against the
///          slip.

#include "dynamics/body/rigid_body.h"

namespace stadion {

/// Velocities of one side that an impulse changes.
struct SolverBody {
  double inverseMass = 0;              ///< 0: nothing moves it
  Mat3 inverseInertia = Mat3::Zero();  ///< in World
  Vec3 p = Vec3::Zero(), v = Vec3::Zero(), omega = Vec3::Zero();
  Quat q = Quat::Identity();  ///< orientation: for a body C to World, for a collider N to World

  Vec3 velocityAt(const Vec3& x) const { return v + omega.cross(x - p); }
  void apply(const Vec3& impulse, const Vec3& x) {
    v += inverseMass * impulse;
    omega += inverseInertia * (x - p).cross(impulse);
  }
};

SolverBody solverBodyOf(const RigidBody& b, double tau);
SolverBody solverBodyOf(const Collider& c, double tau);

/// Change of velocity at x per impulse at x.
Mat3 response(const SolverBody& m, const Vec3& x);

/// Resolves the approach of a against b at x, n from b to a. Returns the impulse on a; zero if they part
/// already.
Vec3 collide(SolverBody& a, SolverBody& b, const Vec3& x, const Vec3& n, double restitution, double friction);

}  // namespace stadion
