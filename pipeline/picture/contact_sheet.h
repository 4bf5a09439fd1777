#pragma once
/// One picture of a whole frame: the walls side by side, an eye a row, each labelled.
///
/// Threads  pure functions.
/// Errors   a wall without a picture leaves its cell empty.

#include "pipeline/picture/picture.h"

#include <span>

namespace stadion {

/// The pictures of one wall.
struct WallPictures {
  std::string wall;
  const Picture* left = nullptr;
  const Picture* right = nullptr;  ///< nullptr without stereo
  /// Width by height of the wall itself, which need not have square pixels; 0 = as the picture.
  double aspect = 0;
};

/// The picture at another size, averaged in linear light over exactly the area of each new pixel.
Picture resized(const Picture& picture, std::uint32_t width, std::uint32_t height);

/// Each view is at most `cellWidth` wide, in the proportions of its wall, and never enlarged. The labels are
/// the wall, L or R, and the frame.
Picture contactSheet(std::span<const WallPictures> walls, std::uint64_t frame, std::uint32_t cellWidth = 320);

}  // namespace stadion
