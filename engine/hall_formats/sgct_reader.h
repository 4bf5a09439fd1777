#pragma once
/// Reads configurations of SGCT (Simple Graphics Cluster Toolkit, github.com/sgct/sgct), version 1 of its JSON
/// schema.
///
/// SGCT draws viewports of windows; each becomes a wall, or a projector if it is warped, masked, round, or for
/// one eye. Its axes are those of OpenGL (+X right, +Y up, +Z back); the origin is kept.
///
///     ProjectionPlane               a wall
///     PlanarProjection              a wall `distance` (at most 10 m) before the user
///     TextureMappedProjection       the same with a mesh
///     FisheyeProjection             a dome of `diameter` (14.8 m) around the user, and a fisheye in its middle
///     Equirectangular-, CylindricalProjection   measured points of a sphere, of a cylinder
///     SphericalMirrorProjection     measured points of a dome, of four meshes
///     CubemapProjection             six walls of a cube of 10 m around the user
///
/// Threads  pure function.
/// Errors   go to the Diagnostics with the JSON path. What is not understood is a warning.

#include "engine/hall_formats/hall_builder.h"
#include "engine/hall_formats/neighbour_files.h"

namespace stadion {

std::optional<WallFile> readSgct(const std::string& text, const std::string& file,
                                 const NeighbourFiles& files, Diagnostics& out);

}  // namespace stadion
