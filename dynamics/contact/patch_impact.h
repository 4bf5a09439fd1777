#pragma once
/// Impacts of solids that come flat on, or nearly: several points at once.
///
/// Points that are nearly as near as the first one, and will touch as soon, take part in one impact, in which
/// each rebounds (Newton's restitution). One by one, in whatever order rounding has them touch, they would
/// turn a body that lands flat.

#include "dynamics/body/impulse.h"
#include "dynamics/collision/touch.h"

#include <optional>
#include <vector>

namespace stadion {

/// A further side that stands as still as b and is struck in the same moment, as the next piece of a floor
/// is.
struct PatchSide {
  Side side;
  double restitution = 0, friction = 0;
  double closing = 0;           ///< set: of its fastest point; 0: it is not struck [m/s]
  Vec3 impulse = Vec3::Zero();  ///< set: on a [N s]
  Vec3 middle = Vec3::Zero();   ///< set: of the impulses, in World
};

struct PatchImpact {
  Vec3 impulse = Vec3::Zero();  ///< on a [N s]
  Vec3 middle = Vec3::Zero();   ///< middle of the impulses, in World
};

/// The impact of a against b, and against what is `beside` b, that begins with the touch `first`, if it has
/// more points than that one: changes the velocities of the solverBodies. None of it brings energy.
std::optional<PatchImpact> collidePatch(const Side& a, const Side& b, double tau, const Gap& first,
                                        SolverBody& ma, SolverBody& mb, double restitution, double friction,
                                        std::vector<PatchSide>& beside);

}  // namespace stadion
