#pragma once
/// Simplified levels of a mesh: fewer triangles over the same vertices, and how far they are from the full
/// surface.
///
/// The surface is taken apart into pieces that hang together. Which triangles of a piece go is
/// meshoptimizer's choice (edges collapse in the order of their quadric error, which is a mean). How great
/// the error is, is measured: from every vertex of the piece, and from points on its triangles, to what is
/// left of it, and back again; the greatest of these distances counts. A piece that cannot be simplified
/// within a level's error stays as it is, and one whose colours or picture would change where it is seen.
///
/// Threads  pure; the loader's, while the show runs.

#include "engine/asset/mesh.h"

namespace stadion {

/// Gives the mesh up to `count` levels, each with at most three quarters of the triangles of the one before;
/// errors are tried from a quarter of a millionth of its size upwards. Changes the mesh's hash: it is another
/// one than that without levels.
void addLevels(Mesh& mesh, std::size_t count);

/// The greatest distance from sampled points of one surface to the other, both ways [m]. Expects triangles.
double surfaceDistance(const Mesh& mesh, const std::vector<std::uint32_t>& a,
                       const std::vector<std::uint32_t>& b);

}  // namespace stadion
