#pragma once
/// What contacts may do to the energy of an island that nothing moves from outside: lower it.
///
/// Method   impulses that are `a` times as strong do the work a b + a^2 c on the members. If the work would
///          be positive, all impulses are weakened by one factor until it is not. So the total momentum
///          stays. Overlap is pushed out at a speed of its own. Bodies that do not move as fast already may
///          receive the work that this takes.
///
///          A step of finite length makes small errors of either sign: the forces on a wobbling coin do some work,
///          though true ones do none. If only the positive errors were taken away, the coin would sink into the
///          floor. So the work that forces took in earlier steps may come back, up to kCredit of the bodies'
///          kinetic energy.

#include "dynamics/body/impulse.h"

#include <cstddef>
#include <vector>

namespace stadion {

constexpr double kCredit = 3e-4;  ///< share of the kinetic energy that may come back later

/// Weakens the impulses of a step until they do no more work than allowed. Returns the work that is left [J].
///
/// `members` is the number of bodies that impulses move; the bodies behind them stay as they are. `free` are
/// the velocities without the impulses. `end` are the velocities with them, and receives the result. `falls`
/// is, by body, how much its velocity at the end of the step exceeds the mean of the step [m/s]; empty if the
/// impulses act at one instant. `allowed` is the work that the impulses may do [J].
double boundWork(std::size_t members, const std::vector<SolverBody>& free, std::vector<SolverBody>& end,
                 const std::vector<Vec3>& falls, double allowed);

/// Returns the energy that turning takes from the spins on the way from `start` to `free` [J]. The spin of a body
/// keeps its angular momentum, but contacts turn the body, and its inertia with it.
double turningWork(std::size_t members, const std::vector<SolverBody>& start,
                   const std::vector<SolverBody>& free);

/// Returns the bodies' kinetic energy [J].
double kineticEnergy(std::size_t members, const std::vector<SolverBody>& bodies);

/// Returns the energy that pushing out overlap at `speed` may cost in a step of h seconds [J].
double pushOutWork(std::size_t members, const std::vector<SolverBody>& start, const std::vector<Vec3>& pull,
                   double h, double speed);

}  // namespace stadion
