#pragma once
/// Simplified levels of a mesh: fewer triangles over the same vertices, and their distance from the full
/// surface.
///
/// The surface is divided into connected pieces. meshoptimizer chooses the triangles of a piece to remove
/// (edges collapse in the order of their quadric error, which is a mean). The error itself is measured. It is
/// the greatest distance from every vertex of the piece, and from points on its triangles, to the simplified
/// piece, and back. A piece stays as it is if it cannot be simplified within a level's error, or if its
/// visible colours or textures would change.
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
