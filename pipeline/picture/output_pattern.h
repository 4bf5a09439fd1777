#pragma once
/// Patterns for setting up one output: they know its pixels and its name, and nothing of the room.
///
/// Units    pixels.
/// Threads  pure functions.

#include "engine/display/wall.h"
#include "pipeline/picture/picture.h"

#include <optional>
#include <string>

namespace stadion {

/// Returns lines every 100 pixels with their numbers, a border on the outermost pixels, the diagonals, the
/// output's name, and L or R.
Picture pixelPattern(const std::string& name, std::optional<Eye> eye, std::uint32_t width,
                     std::uint32_t height);

/// Returns rows of black and white beside even greys. Where a grey is as bright as the rows, its number is the
/// output's gamma.
Picture gammaPattern(std::uint32_t width, std::uint32_t height);

/// Returns bars of the eight full colours above steps of grey from black to white.
Picture barPattern(std::uint32_t width, std::uint32_t height);

}  // namespace stadion
