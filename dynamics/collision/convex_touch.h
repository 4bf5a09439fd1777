#pragma once
/// When convex bodies first touch each other, a plane or a mesh.
///
/// Method   conservative advancement. For a fixed direction n the gap between two moving bodies is at least
///            f(s) = min over a of n . (x + s v_x) - max over b of n . (x + s v_x) - A s^2 / 2,
///          A a bound on the acceleration of points. The two extremes are supports along n + s n x omega, so
///          f is exact in s but for A, and concave: a step to its root cannot pass a contact however fast the
///          bodies turn, and near one the steps converge quadratically. Far off, a second bound holds the
///          bodies inside their spheres, where their spin does not count. Where a face rocks on an edge, or
///          two edges cross, corners beside the contact come through a fixed plane: there n turns with that
///          face or those edges, n + s w x n, which adds to A what two speeds can make of it.

#include "dynamics/collision/touch.h"
#include "dynamics/shapes/convex_core.h"

namespace stadion {

/// Returns the first touch of two convex shapes (convex_core.h).
std::optional<Touch> convexTouch(const Side& a, const Side& b, double from, double to,
                                 std::uint64_t& iterations);
/// A convex body and an unbounded plane.
std::optional<Touch> planeTouch(const Side& a, const Side& plane, double from, double to,
                                std::uint64_t& iterations);
/// A convex body and a mesh, triangle by triangle.
std::optional<Touch> meshTouch(const Side& a, const Side& mesh, double from, double to,
                               std::uint64_t& iterations);

/// Distances of the same pairs; normal from b to a.
Gap convexGapBetween(const Shape& a, const Pose& X_WA, const Shape& b, const Pose& X_WB);
Gap planeGapBetween(const Shape& a, const Pose& X_WA, const PlaneShape& plane, const Pose& X_WP);
Gap meshGapBetween(const Shape& a, const Pose& X_WA, const MeshShape& mesh, const Pose& X_WM, double limit);

/// Bound on the acceleration of A's points as seen from B's turning frame, both within [from, to]
/// (touch.cpp).
double relativeAcceleration(const Side& a, const Side& b, double from, double to, double distance);

}  // namespace stadion
