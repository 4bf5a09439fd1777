#pragma once
/// How far a picture's details lie from their places to the left or right, and what that does to depth.
///
/// Method     The picture is divided into blocks. Each is compared with the reference at whole-pixel shifts,
///            then a least-squares fit on the brightness finds the fraction. Blocks without contrast are left
///            out.
/// Units      pixels, positive to the right.
/// Threads    plain functions.

#include "pipeline/picture/picture.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace stadion::bench {

/// A square of a picture.
struct PictureBlock {
  static constexpr std::uint32_t kSide = 16;  ///< [pixels]
  std::uint32_t x = 0, y = 0;                 ///< its top left corner
};

/// One channel of brightness, 0 to 255, of a picture.
class Brightness {
public:
  explicit Brightness(const Picture& picture);

  std::uint32_t width() const { return width_; }
  std::uint32_t height() const { return height_; }
  float at(std::uint32_t x, std::uint32_t y) const { return values_[std::size_t{y} * width_ + x]; }
  /// Between pixels of a row: a cubic through four of them. Expects 1 <= x < width - 2.
  float between(double x, std::uint32_t y) const;

private:
  std::uint32_t width_, height_;
  std::vector<float> values_;
};

/// How far the block of the picture lies to the right of the reference's, -2 to 2. Nothing if the reference
/// has too little contrast there, or the block lies too near to the edge: so all pictures are judged by the
/// same blocks.
std::optional<double> shiftOf(const PictureBlock& block, const Brightness& picture,
                              const Brightness& reference);

/// The pictures of both eyes.
struct EyePair {
  const Picture& left;
  const Picture& right;
};

/// The errors of disparity over all blocks that both eyes see with enough contrast.
struct DisparityErrors {
  double mean = 0;         ///< of the absolute values
  double p95 = 0;          ///< 95 % are at most this
  std::size_t blocks = 0;  ///< number of blocks
};
/// For each block of the left eye the reference tells where the right eye sees it. Then the disparity is
/// wrong by the shift of the block in the right eye less its shift in the left one.
DisparityErrors disparityErrors(const EyePair& pictures, const EyePair& references);

}  // namespace stadion::bench
