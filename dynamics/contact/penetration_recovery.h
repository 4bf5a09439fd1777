#pragma once
/// Lets a body return out of a mesh, a bounded plane, a box or a hull into which a hand has put it.
/// Internal to dynamics/.
///
/// Method   a deep overlap has no shortest way out that could be trusted. A sheet has no inside, and a thin
///          pole is nearer to a triangle's edge than to the surface. So the body returns to the place where
///          it was free last. It leaves through the face that its middle has crossed. If there is none, it
///          leaves through the overlapped face that points most in that direction. Until the body is out, the
///          collider acts as the half-space below a plane. The plane is normal to the face, and as high as the
///          collider reaches above the body.
/// Frames   recoveries in the coordinates of the collider, which may move; all else in World.

#include "dynamics/collision/touch.h"

#include <optional>

namespace stadion {

/// A body deeper than this below a face is not inside of it: the hand has gone round it [m].
constexpr double kDeepest = 1;

/// Returns true if the segment `from`–`to` crosses a face of the collider and ends less than kDeepest below.
bool wentInto(const Side& collider, double tau, const Vec3& from, const Vec3& to);

/// Returns true if the body overlaps the collider by more than bodies at rest do.
bool overlaps(const Side& body, const Side& collider, double tau);

/// Returns nothing if the body is not inside of the collider, or if the collider is round or has no bounds.
/// The body's middle was at `free` when the body last touched nothing.
std::optional<PenetrationRecovery> penetrationRecoveryOf(const Side& body, const Side& collider, double tau,
                                                         const Vec3& free);

/// Returns the plane, at rest in World, that replaces the collider; nothing if the body is out.
std::optional<PlaneShape> barrier(const Side& body, const Side& collider, double tau,
                                  const PenetrationRecovery& recovery);

}  // namespace stadion
