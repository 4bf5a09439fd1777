#pragma once
/// Where a wall's pictures come out, and what has to be done to them on the way there.
///
/// A projector may stand behind its screen, hang upside down, throw over a mirror or from the side, and no
/// two show the same white. The picture is mirrored, then turned, then drawn into the four corners; last its
/// colours are set.
///
/// Units    pixels of the screen; shares of the output's width and height from its upper left corner.
/// Threads  plain values.

#include "engine/maths/maths.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string>

namespace stadion {

/// The changes to a picture before it is shown.
struct OutputShape {
  bool flipH = false, flipV = false;  ///< left becomes right; top becomes bottom
  std::uint32_t rotate = 0;           ///< clockwise: 0, 90, 180 or 270 [degrees]
  bool swapEyes = false;
  /// Where the picture's upper left, upper right, lower right and lower left corner come to lie, after it has
  /// been mirrored and turned.
  std::optional<std::array<Vec2, 4>> warp;
  std::array<double, 3> gamma{1, 1, 1};  ///< per channel; above 1 brightens what is between dark and light
  std::array<double, 3> brightness{1, 1, 1};  ///< part of the light, per channel, from 0 to 1

  bool turnsColours() const {
    return gamma != std::array<double, 3>{1, 1, 1} || brightness != std::array<double, 3>{1, 1, 1};
  }
  bool operator==(const OutputShape&) const = default;
};

/// Where an output is.
struct OutputPlace {
  std::string screen;   ///< an X screen, such as :0.1; empty = the one of DISPLAY
  std::string monitor;  ///< name of the monitor, or its number from 1; empty = no monitor is named
  struct Rectangle {
    std::int32_t x = 0, y = 0;
    std::uint32_t width = 0, height = 0;
    bool operator==(const Rectangle&) const = default;
  };
  std::optional<Rectangle> rectangle;  ///< on the monitor, or on the screen
  bool fullscreen = false;
  std::uint32_t refresh = 0;  ///< [1/s]; 0 = as it is

  bool operator==(const OutputPlace&) const = default;
};

struct WallOutput {
  OutputPlace place;
  OutputShape shape;

  bool operator==(const WallOutput&) const = default;
};

/// Maps a point of the output to the point of the picture that is shown there, both in shares from the upper
/// left corner, in homogeneous coordinates. What falls outside 0..1 is black.
Mat3 pictureFromOutput(const OutputShape& shape);

/// The map that takes the corners of the unit square (upper left, upper right, lower right, lower left) to
/// the four points. Nothing if three of them lie on a line or the quadrangle crosses itself.
std::optional<Mat3> squareToQuad(const std::array<Vec2, 4>& corners);

}  // namespace stadion
