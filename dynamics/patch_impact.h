#pragma once
/// Impacts of solids that come flat on, or nearly: several points at once.
///
/// Points that are nearly as near as the first one, and will touch as soon, take part in one impact, in which
/// each rebounds (Newton's restitution). One by one, in whatever order rounding has them touch, they would
/// turn a body that lands flat.

#include "dynamics/impulse.h"
#include "dynamics/touch.h"

#include <optional>

namespace stadion {

struct PatchImpact {
  Vec3 impulse = Vec3::Zero();  ///< on a [N s]
  Vec3 middle = Vec3::Zero();   ///< of the impulses, in World
};

/// The impact of a against b that begins with the touch `first`, if it has more points than that one: changes
/// the velocities of the mobiles. None of it brings energy.
std::optional<PatchImpact> collidePatch(const Side& a, const Side& b, double tau, const Gap& first,
                                        Mobile& ma, Mobile& mb, double restitution, double friction);

}  // namespace stadion
