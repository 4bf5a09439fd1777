#pragma once
/// Short labels on pictures, in a built-in bitmap font of 5 x 7 points.
///
/// Threads  pure functions.

#include "pipeline/picture/picture.h"

#include <array>
#include <string_view>

namespace stadion {

constexpr std::uint32_t kLetterWidth = 6;   ///< with the gap, times the scale [pixels]
constexpr std::uint32_t kLetterHeight = 8;  ///< with the gap, times the scale [pixels]

/// Writes the text with its top left corner at (x, y), cut off at the picture's edge. Unknown characters are
/// shown as '?'.
void letter(Picture& picture, std::uint32_t x, std::uint32_t y, std::string_view text,
            std::array<std::uint8_t, 3> colour, std::uint32_t scale = 1);

}  // namespace stadion
