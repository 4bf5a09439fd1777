#pragma once
/// Lines in a picture.
///
/// Units    pixels from the upper left corner.
/// Threads  one at a time.

#include "engine/maths/maths.h"
#include "pipeline/picture/picture.h"

#include <array>
#include <cstdint>
#include <utility>

namespace stadion {

class Sketch {
public:
  using Colour = std::array<std::uint8_t, 3>;

  Sketch(std::uint32_t width, std::uint32_t height, const Colour& ground) : picture_(width, height) {
    fill(0, 0, width, height, ground);
  }
  /// Draws on a picture.
  explicit Sketch(Picture picture) : picture_(std::move(picture)) {}
  Picture take() { return std::move(picture_); }
  Picture& picture() { return picture_; }
  double width() const { return picture_.width; }
  double height() const { return picture_.height; }

  void line(Vec2 a, Vec2 b, const Colour& colour, int thick = 1);
  /// Fills the part of the rectangle that lies in the picture.
  void fill(std::uint32_t x, std::uint32_t y, std::uint32_t width, std::uint32_t height,
            const Colour& colour);
  /// Draws the outermost pixels.
  void border(const Colour& colour);

private:
  void dot(int x, int y, const Colour& colour, int thick);
  bool clip(Vec2& a, Vec2& b) const;

  Picture picture_;
};

}  // namespace stadion
