#pragma once
/// Properties of a mesh that follow from its triangles alone.

#include "engine/asset/mesh.h"

namespace stadion {

/// Fills bounds, bounding sphere and content hash from the rest. Expects finite positions.
void finish(Mesh& mesh);

/// True if the surface encloses a volume: with corners at equal positions taken as one, every edge is used as
/// often in one direction as in the other. Such a mesh has a mass; the others are shells.
bool closed(const Mesh& mesh);

/// Sum of the areas of all triangles [m²].
double area(const Mesh& mesh);

/// For every vertex the number of the first vertex at the same position, of a figure with the same joints: other
/// vertices leave it when the figure moves. `joints` is empty or as long as the positions.
std::vector<std::uint32_t> weldPositions(const std::vector<std::array<float, 3>>& positions,
                                         const std::vector<VertexJoints>& joints = {});

}  // namespace stadion
