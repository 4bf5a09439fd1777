#pragma once
/// Contact points of two boxes: the face of one clipped by the face of the other, or two edges that cross.

#include "dynamics/collision/manifold.h"
#include "dynamics/shapes/shape.h"

namespace stadion {

/// Points closer than `margin`, normal from b to a; A and B are the boxes' own frames in World.
void boxManifold(const Pose& A, const Vec3& halfA, const Pose& B, const Vec3& halfB, double margin,
                 std::vector<ManifoldPoint>& points);

/// Greatest separation along the fifteen axes that can separate boxes, negative when they overlap. `axis`
/// from b to a; `edges`: it is square to an edge of each.
double separatingAxis(const Pose& A, const Vec3& halfA, const Pose& B, const Vec3& halfB, Vec3& axis,
                      bool& edges);

}  // namespace stadion
