#pragma once
/// Reads warp meshes of other programs, as SGCT documents and reads them.
///
///     .data          Paul Bourke: the kind of the source, columns and rows, then x y s t light a vertex, from the
///                    lower left; x from -aspect to aspect, y from -1 to 1; a light below 0 shows nothing
///     .obj           Wavefront: v is a place from -1 to 1 of the window, the vt of the same number the source;
///                    faces are triangles, or fans of more corners
///     .pfm           a grid of source shares (x, y up), the first row at the top, from edge to edge
///     .csv           domeprojection: x;y;u;v;column;row a vertex, from the upper left
///     .simcad        XML: a square of offsets in x and y, divided by their range
///     .skyskan, .txt SkySkan: view angles, columns and rows, then x y u v a vertex
///     .ol            Scalable EasyBlend OpenMesh 1.1: settings, vertices (x y light s t), faces in brackets
///     .sgc           SCISS, versions 1 and 2, planar: view, vertices and triangles in binary
///
/// Sources of the formats: SGCT's schema and user documentation; paulbourke.net/dataformats/meshwarp; the PFM
/// page of netpbm. Place and source of a vertex are turned into shares from the upper left corner.
///
/// Bounds   counts are compared with the rest of the file before memory is taken.
/// Threads  pure function.
/// Errors   go to the Diagnostics with the file's name, and the line of a text file.

#include "engine/base/diagnostic.h"
#include "engine/hall_formats/warp_mesh.h"

#include <string>
#include <string_view>

namespace stadion {

inline constexpr std::size_t kMostWarpFileBytes = 256U << 20;

struct WarpFile {
  WarpMesh mesh;
  bool ofWindow = false;         ///< shares are of the window, not of the viewport
  std::optional<WarpView> view;  ///< if the file states the view of its source
};

/// Reads the bytes of a warp file by the ending of its name. `aspect` is width / height of the output that it
/// covers. Nothing and an error if the file is wrong or its kind is unknown.
std::optional<WarpFile> readWarpFile(std::string_view bytes, const std::string& file, double aspect,
                                     Diagnostics& out);

/// Returns the endings that readWarpFile knows, for messages.
std::string warpFileEndings();

}  // namespace stadion
