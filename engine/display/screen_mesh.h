#pragma once
/// Reads files of measured points: meshes (OBJ) and grids (PFM).
///
/// OBJ   `v` and `f` lines; faces of any number of corners, counted from 1 or backwards from the last point,
///       as i, i/j, i//k or i/j/k. Normals, texture coordinates, groups and materials say nothing about a
///       shape. Other statements are skipped and named in one warning.
/// PFM   three channels, either byte order, rows from the bottom to the top as the format has them. Values
///       that are no numbers, infinite or very large are points off the screen. The size of the scale has
///       no meaning for points; its sign is the byte order.
///
/// Frames   rig space. Units: metres here, multiples of `metresPerUnit` there.
/// Threads  pure functions.
/// Errors   go to the Diagnostics with the file's name, and the line of an OBJ file.

#include "engine/base/diagnostic.h"
#include "engine/display/screen.h"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace stadion {

inline constexpr std::uint32_t kMaxGridSide = 16384;
inline constexpr std::uint64_t kMaxGridPoints = 64ULL << 20;
inline constexpr std::size_t kMaxMeshPoints = 4U << 20;     ///< of a screen
inline constexpr std::size_t kMaxMeshTriangles = 4U << 20;  ///< of a screen

/// Points in rows, the first row at the top.
struct PointGrid {
  std::uint32_t columns = 0, rows = 0;
  std::vector<Vec3> points;  ///< (rows x columns) [m]; NaN: off the screen
};

/// Reads the bytes of a PFM file; nothing if it has errors.
std::optional<PointGrid> readPointGrid(std::string_view bytes, const std::string& file, double metresPerUnit,
                                       Diagnostics& out);

/// Reads the text of an OBJ file; nothing if it has errors. MeshScreen::file is `file`.
std::optional<MeshScreen> readObjMesh(std::string_view text, const std::string& file, double metresPerUnit,
                                      Diagnostics& out);

/// Makes triangles between neighbours of a grid; nothing and an error if the grid has none or too many.
std::optional<MeshScreen> meshOfGrid(const PointGrid& grid, const std::string& file, Diagnostics& out);

}  // namespace stadion
