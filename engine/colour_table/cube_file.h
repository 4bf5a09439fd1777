#pragma once
/// Reads and writes colour tables as `.cube` files.
///
///     TITLE "left projector"         these lines come first, in any order
///     LUT_3D_SIZE 33                 or LUT_1D_SIZE N; with both, the rows of the curves come first
///     DOMAIN_MIN 0 0 0               places of the first and the last row of each channel (0 and 1)
///     DOMAIN_MAX 1 1 1
///     LUT_1D_INPUT_RANGE 0 1         the same for all channels of one table; likewise LUT_3D_INPUT_RANGE
///     0.0 0.0 0.0                    then red, green, blue of each entry; red varies first
///
/// Bounds   curves have at most kMostCurveEntries, solids at most kMostSolidSide grid points along an edge. A file gets
///          memory only for rows that it has.
/// Threads  pure functions.
/// Errors   go to the Diagnostics with the file's name, line and column.
/// Sources  Adobe, "Cube LUT Specification", version 1.0 (2013); the ranges and files with both tables are those of
///          DaVinci Resolve.

#include "engine/base/diagnostic.h"
#include "engine/colour_table/colour_table.h"

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace stadion {

inline constexpr std::uint32_t kMostCurveEntries = 65536;
inline constexpr std::uint32_t kMostSolidSide = 128;
inline constexpr std::size_t kMostCubeBytes = 128U << 20;

/// Reads the text of a file; nothing if it has errors.
std::optional<ColourTable> readCube(std::string_view text, const std::string& file, Diagnostics& out);

/// The table as text that readCube reads back to the same values.
std::string formatCube(const ColourTable& table);

}  // namespace stadion
