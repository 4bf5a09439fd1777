#pragma once
/// Directions that a body has by its form: the axis it spins about, the nose it flies and sticks with.
///
/// Frames  in the node's coordinates N, unit vectors.

#include "dynamics/body/body.h"
#include "dynamics/shapes/mass_properties.h"
#include "engine/asset/mesh.h"

namespace stadion {

/// The principal axis whose moment differs most from the other two: along a rod, across a disc. Its largest
/// component is positive. Z of a body that has no such axis.
Vec3 symmetryAxis(const MassProperties& mass);

/// How a body with this nose sticks, up to `angle` [rad] from straight on, `depth` [m] deep.
TipEmbedding tipEmbeddingAlong(const Vec3& nose, double angle, double depth, const Mesh& mesh);

}  // namespace stadion
