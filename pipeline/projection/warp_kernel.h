#pragma once
/// The inner loops of the warp: the pixels of one cell, from the picture of a facet to the values that the
/// projector gets.
///
/// Method   a place in the picture is linear in the point's homogeneous coordinates, so a smooth cell
///          interpolates between its corners' and divides for each pixel. Four pixels of the picture are
///          averaged in linear light, multiplied by the share, and encoded last. A colour table maps encoded values.
/// Same pixels  on every processor: each operation rounds alike in every variant.
/// Threads  pure functions.

#include <array>
#include <cstddef>
#include <cstdint>

namespace stadion {

constexpr std::size_t kWarpSteps = 4096;  ///< of the root of light

/// Entries of a colour table at even places.
struct TableGrid {
  const float* values = nullptr;  ///< red, green, blue of each entry; null: there is no such table
  int last = 0;                   ///< index of the last entry along an axis, at least 1
  float low[3] = {0, 0, 0};       ///< place of the first entry
  float scale[3] = {1, 1, 1};     ///< entries for each unit
};

/// The colour table of a projector (warp_table.h).
struct WarpTable {
  const float* encoded[3] =
      {};  ///< by channel: the value from 0 to 1 for the light whose root is step / kWarpSteps
  TableGrid curve, solid;
};

/// How light becomes values of the projector.
struct WarpLight {
  std::array<float, 256> linear{};  ///< light of an sRGB value
  /// By channel: the value for the light whose root is step / kWarpSteps.
  std::array<std::array<std::uint8_t, kWarpSteps + 1>, 3> encoded{};
  std::array<float, 3> gain{1, 1, 1};  ///< by channel, for shared light
  const WarpTable* table = nullptr;    ///< maps values after they are encoded; null: none, `encoded` counts
};

/// The picture of a facet (height x width x 4), sRGB.
struct FacetPixels {
  const std::uint8_t* rgba = nullptr;
  std::uint32_t width = 0, height = 0;  ///< at least 2 each
};

/// A pixel or a corner of a cell.
struct WarpPoint {
  float x, y, w;  ///< its place in the picture, homogeneous [pixels; the middle of a pixel is whole]
  float share[3], lift[3];  ///< by channel
};

struct WarpKernels {
  const char* name;
  /// The 8 x 8 pixels of a cell from its corners: upper left, upper right, lower left, lower right.
  void (*smooth)(const WarpPoint (&corners)[4], const FacetPixels& from, const WarpLight& light,
                 std::uint32_t (&pixels)[64]);
  /// The 8 x 8 pixels of a cell from a point for each.
  void (*exact)(const WarpPoint (&points)[64], const FacetPixels& from, const WarpLight& light,
                std::uint32_t (&pixels)[64]);
};

extern const WarpKernels kWarpByFour, kWarpByEight, kWarpBySixteen;

/// Returns the fastest kernels of this processor.
const WarpKernels& bestWarpKernels();

}  // namespace stadion
