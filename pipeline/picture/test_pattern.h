#pragma once
/// A picture for placing walls and aligning projectors.
///
/// It shows a border on the outermost pixels, lines every quarter of a metre and heavy ones every metre from
/// the lower left corner, a circle that must be round, the wall's name, and L or R. It also shows a cube of
/// one metre in the middle of the room, half a metre above the floor, as the standing visitor's eye sees it.
/// If the walls are where their file says, the cube's edges continue straight from wall to wall.
///
/// Units    metres, pixels.
/// Threads  pure functions.

#include "engine/display/wall_file.h"
#include "pipeline/picture/picture.h"

#include <optional>

namespace stadion {

/// Returns the picture of wall `index` for one eye. Without an eye, it is for a single eye between the two,
/// and has no letter.
Picture testPattern(const WallFile& walls, std::size_t index, std::optional<Eye> eye, std::uint32_t width,
                    std::uint32_t height);

}  // namespace stadion
