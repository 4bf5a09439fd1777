#pragma once
/// A picture by which walls are put up and projectors are lined up.
///
/// A border on the outermost pixels, lines every quarter of a metre and heavy ones every metre from the lower
/// left corner, a circle that must be round, the wall's name, L or R, and a cube of one metre in the
/// middle of the room, half a metre above the floor. The cube is drawn as the standing visitor's eye sees it:
/// on walls that are where their file says, its edges go on straight from wall to wall.
///
/// Units    metres, pixels. Threads  pure functions.

#include "engine/display/wall_file.h"
#include "pipeline/picture/picture.h"

#include <optional>

namespace stadion {

/// Of the wall `index`, for one eye, or, without one, for a single eye between the two (and no letter).
Picture testPattern(const WallFile& walls, std::size_t index, std::optional<Eye> eye, std::uint32_t width,
                    std::uint32_t height);

}  // namespace stadion
