#pragma once
/// Textures of the models, as PNG files. They are written without compression, because a compressor's output
/// depends on its version.

#include <cstdint>
#include <string>
#include <vector>

namespace stadion::assets {

enum class PngColour : std::uint8_t { Grey = 0, Palette = 3 };

struct PngKind {
  std::uint8_t bits;  ///< a pixel
  PngColour colour;
};

/// `rows`: each a zero byte, then its pixels. `palette`: three bytes a colour, or empty.
std::string png(std::uint32_t width, std::uint32_t height, PngKind kind, const std::string& palette,
                const std::string& rows);

/// Square grey textures that repeat without a seam. They are near white: the model gives the colour.
std::string earthPicture();   ///< trodden sand with pebbles, for 3 x 3 m
std::string meadowPicture();  ///< dry grass, for 4 x 4 m
std::string stonePicture();   ///< shelly limestone, for 2 x 2 m
std::string leavesPicture();  ///< foliage, for 1.5 x 1.5 m

}  // namespace stadion::assets
