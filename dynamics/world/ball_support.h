#pragma once
/// Flat faces that carry a ball in closed form.
///
/// Threads  one at a time, as the world that it belongs to (world.h).

#include "dynamics/body/rigid_body.h"
#include "dynamics/collision/touch.h"

namespace stadion {

/// Returns true if a ball at this gap from a collider has closed forms there: on a flat face of a still
/// collider.
bool carries(const RigidBody& ball, const Collider& c, const Gap& gap);
/// Finds the face that carries the ball, with its edges and surface values. Returns false if nothing carries
/// it.
bool supportFor(const RigidBody& ball, const Collider& c, const Gap& gap, Support& out);

}  // namespace stadion
