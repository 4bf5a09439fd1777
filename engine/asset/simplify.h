#pragma once
/// Simplified levels of a mesh: fewer triangles over the same vertices, and how far they are from the full
/// surface.
///
/// Which triangles go is meshoptimizer's choice (edges collapse in the order of their quadric error). How
/// great the error is, is measured afterwards: from every vertex of the full surface, and from points on its
/// triangles, to the level's surface, and back again. The greatest of these distances is the level's error.
///
/// Threads  pure; the loader's, while the show runs.

#include "engine/asset/mesh.h"

namespace stadion {

/// Gives the mesh up to `count` levels, each with about half the triangles of the one before, as long as
/// they become fewer. Changes the mesh's hash: it is another one than that without levels.
void addLevels(Mesh& mesh, std::size_t count);

/// The greatest distance from sampled points of one surface to the other, both ways [m]. Expects triangles.
double surfaceDistance(const Mesh& mesh, const std::vector<std::uint32_t>& a,
                       const std::vector<std::uint32_t>& b);

}  // namespace stadion
