#pragma once
/// Which way a body gets out of a mesh, a bounded plane, a box or a hull that a hand has put it into.
/// Internal to dynamics/.
///
/// Method   what a body overlaps deeply has no shortest way out that could be trusted: a sheet has no inside,
///          and a thin pole is nearer to a triangle's edge than to the surface. So the way is that back to
///          where the body was free last: out of the face through which its middle has gone, else of the one
///          that it overlaps and that looks most that way. Until it is out, the thing counts to it as all
///          that lies below a plane across that way, as high as what is above the body reaches.
/// Frames   ways in the coordinates of the thing, which may move; all else in World.

#include "dynamics/collision/touch.h"

#include <optional>

namespace stadion {

/// Deeper than this below a face nothing is in it any more: a hand has got there by some other way [m].
constexpr double kDeepest = 1;

/// Whether the straight way between the two places goes through a face of the thing, no deeper than that.
bool wentInto(const Side& thing, double tau, const Vec3& from, const Vec3& to);

/// Whether the body overlaps it by more than bodies at rest do.
bool overlaps(const Side& body, const Side& thing, double tau);

/// Nothing if the body, whose middle was at `free` when it last touched nothing, is not inside of the thing,
/// or if that is round or has no bounds.
std::optional<WayOut> wayOutOf(const Side& body, const Side& thing, double tau, const Vec3& free);

/// The plane, at rest in World, that the thing counts as; nothing if the body is out.
std::optional<PlaneShape> barrier(const Side& body, const Side& thing, double tau, const WayOut& way);

}  // namespace stadion
