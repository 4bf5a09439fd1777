#pragma once
/// A picture as it lies in its place of a window, row by row: mirrored, turned, stretched, or drawn into four
/// corners.
///
/// Filter   between four pixels with weights of 8 bits, as graphics cards do. A picture that fills its place
///          pixel by pixel is not filtered. Outside of the picture is black.
/// Pixels   0xAABBGGRR: the bytes of a Picture in their order.
/// Threads  one at a time.

#include "engine/display/output.h"
#include "pipeline/picture/picture.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace stadion {

class PictureRows {
public:
  /// Into a place of width x height pixels. The picture must outlive it, and must not be empty.
  PictureRows(const Picture& picture, const OutputShape& shape, std::uint32_t width, std::uint32_t height);

  /// The pixels of row `y` of the place from column `begin` on.
  void read(std::uint32_t y, std::uint32_t begin, std::span<std::uint32_t> pixels);

private:
  enum class Way { Copied, Stretched, Warped };
  /// Two neighbours, and how much the second one counts [1/256].
  struct Between {
    std::uint32_t first, second, weight;
  };

  static std::int32_t placeOf(float share, std::uint32_t size);
  static Between between(float share, std::uint32_t size);
  float down(std::uint32_t y) const;
  void copy(std::uint32_t y, std::uint32_t begin, std::span<std::uint32_t> pixels) const;
  void stretch(std::uint32_t y, std::uint32_t begin, std::span<std::uint32_t> pixels);
  const std::vector<std::uint32_t>& wideRow(std::uint32_t y);
  void warp(std::uint32_t y, std::uint32_t begin, std::span<std::uint32_t> pixels);
  std::uint32_t pixel(std::uint32_t x, std::uint32_t y) const;
  std::uint32_t sample(float across, float down) const;

  const Picture& picture_;
  std::uint32_t width_, height_;
  std::array<float, 9> toPicture_{};  ///< rows of the matrix, from shares of the place
  Way way_;
  std::vector<Between> columns_;                    ///< Stretched: by column of the place
  std::array<std::vector<std::uint32_t>, 2> wide_;  ///< Stretched: rows of the picture, as wide as the place
  std::array<std::uint32_t, 2> wideOf_{~0u, ~0u};   ///< numbers of these rows in the picture
  std::vector<float> across_, down_, depth_;  ///< Warped: shares of the picture; behind it if not above 0
};

}  // namespace stadion
