#pragma once
/// Where two convex bodies, or one and a plane or a mesh, touch: the part of one's flat or straight side that
/// lies over the other's.

#include "dynamics/collision/convex_gap.h"
#include "dynamics/collision/manifold.h"

namespace stadion {

/// All that this file is for: false for pairs that others look after (a box on an unbounded plane, meshes on
/// planes and each other).
bool solidManifold(const Side& a, const Side& b, double tau, double margin,
                   std::vector<ManifoldPoint>& points);

/// Points of two bodies closer than `margin` in R's frame, appended; at most 8.
void convexManifold(const ConvexCore& a, const ConvexCore& b, const ConvexGap& gap, double margin,
                    std::uint32_t keyBase, std::vector<ManifoldPoint>& points);

/// Against the side below n . x = level of an unbounded plane.
void planeManifold(const ConvexCore& a, const Vec3& n, double level, double margin,
                   std::vector<ManifoldPoint>& points);

/// Against a mesh, node placed by X_RM. Edges merged in triangle_tree.h carry nothing of their own.
void meshManifold(const ConvexCore& a, const MeshShape& mesh, const Pose& X_RM, double margin,
                  std::vector<ManifoldPoint>& points);

/// The direction from the triangle to the body: the face's own where an edge is merged away. False: some
/// other triangle speaks for this place.
bool meshNormal(const ConvexCore& a, const ConvexCore& face, const TriangleTree& tree, std::uint32_t triangle,
                ConvexGap& gap);

}  // namespace stadion
