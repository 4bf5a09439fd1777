#pragma once
/// What contacts may do to the energy of an island that nothing moves from outside: lower it.
///
/// Method   the work of all impulses on the members is a b + a^2 c if they are `a` times as strong: where it
/// would be positive they are weakened, all alike, until it is not. So momenta stay what they are. Overlap is
/// pushed out at a speed of its own: the work that this takes is allowed to bodies that do not move as fast
/// already.

#include "dynamics/body/impulse.h"

#include <cstddef>
#include <vector>

namespace stadion {

/// `free` are the velocities without the impulses, `end` those with them; a body that falls does so, on the
/// mean of the step, by `falls` less than at its end [m/s]; empty: an instant. `allowed` is work that they
/// may do [J]. Those behind the first `members` are moved by nothing.
void boundWork(std::size_t members, const std::vector<SolverBody>& free, std::vector<SolverBody>& end,
               const std::vector<Vec3>& falls, double allowed);

/// Returns the energy that pushing out overlap at `speed` may cost in a step of h seconds [J].
double pushOutWork(std::size_t members, const std::vector<SolverBody>& start, const std::vector<Vec3>& pull,
                   double h, double speed);

}  // namespace stadion
