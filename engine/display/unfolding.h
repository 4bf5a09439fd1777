#pragma once
/// Walls side by side on one sheet: the room unfolded, the front wall in the middle.
///
///              ceiling
///       left    front    right    back
///               floor
///
/// Walls that would come to lie on each other (two screens in a corner, a powerwall of several) stand in one
/// row instead, from left to right as the visitor sees them.
///
/// Threads  pure function.

#include "engine/display/wall_file.h"

namespace stadion {

/// Where a wall stands on the sheet [pixels], from its upper left corner.
struct SheetPlace {
  std::int32_t x = 0, y = 0;
  std::uint32_t width = 0, height = 0;

  bool operator==(const SheetPlace&) const = default;
};

/// Returns a place for each wall, in file order, in the walls' own proportions, as large as fits. Expects at
/// least one wall.
std::vector<SheetPlace> unfold(const std::vector<WallEntry>& walls, std::uint32_t width,
                               std::uint32_t height);

}  // namespace stadion
