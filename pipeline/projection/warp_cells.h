#pragma once
/// The functions of warp_kernel.h, compiled once for each instruction set.
///
/// Linkage  internal. This header includes no header with functions of external linkage.

#include "pipeline/projection/warp_kernel.h"

namespace stadion {
namespace {

constexpr int kCellPixels = 64, kCellSide = 8;

struct CellPlaces {
  float u[kCellPixels], v[kCellPixels], share[3][kCellPixels], lift[3][kCellPixels];
};

/// A place within the picture; what is not a number becomes 0.
inline float withinPicture(float place, float last) {
  const float above = place > 0.0f ? place : 0.0f;
  return above < last ? above : last;
}

/// The place between two entries of a table along an axis.
struct TablePlace {
  int entry;
  float beyond;
};

inline TablePlace placeIn(const TableGrid& grid, int channel, float value) {
  const float place =
      withinPicture((value - grid.low[channel]) * grid.scale[channel], static_cast<float>(grid.last));
  const int below = static_cast<int>(place);
  const int entry = below < grid.last - 1 ? below : grid.last - 1;
  return {entry, place - static_cast<float>(entry)};
}

inline void throughCurves(const TableGrid& grid, float (&values)[3][kCellPixels]) {
  for (int channel = 0; channel < 3; ++channel)
    for (int i = 0; i < kCellPixels; ++i) {
      const TablePlace at = placeIn(grid, channel, values[channel][i]);
      const float a = grid.values[3 * at.entry + channel], b = grid.values[3 * at.entry + 3 + channel];
      values[channel][i] = a + (b - a) * at.beyond;
    }
}

/// From the corner of the cube nearest to black, a way along the edges leads to the opposite one: first along the axis
/// on which the colour is farthest, last along the one on which it is nearest. These corners are the tetrahedron's.
inline void throughSolid(const TableGrid& grid, float (&values)[3][kCellPixels]) {
  const int edge = grid.last + 1, across = 3, along = 3 * edge, up = along * edge,
            whole = across + along + up;
  for (int i = 0; i < kCellPixels; ++i) {
    const TablePlace red = placeIn(grid, 0, values[0][i]), green = placeIn(grid, 1, values[1][i]),
                     blue = placeIn(grid, 2, values[2][i]);
    const float r = red.beyond, g = green.beyond, b = blue.beyond;
    const float least = r < g ? (r < b ? r : b) : (g < b ? g : b),
                most = r > g ? (r > b ? r : b) : (g > b ? g : b);
    const float low = r < g ? r : g, high = r < g ? g : r;
    const float middle = b < low ? low : (b > high ? high : b);
    // Of equal parts, the same one must not be first and last.
    const int first = r >= g && r >= b ? across : g >= b ? along : up;
    const int last = b <= r && b <= g ? up : g <= r ? along : across;
    const float* const corner = grid.values + red.entry * across + green.entry * along + blue.entry * up;
    for (int channel = 0; channel < 3; ++channel) {
      const float black = corner[channel], one = corner[channel + first],
                  two = corner[channel + whole - last], white = corner[channel + whole];
      values[channel][i] = black + (one - black) * most + (two - one) * middle + (white - two) * least;
    }
  }
}

/// Encodes the roots of light, and maps these values.
inline void throughTable(const WarpTable& table, float (&roots)[3][kCellPixels],
                         std::uint32_t (&pixels)[kCellPixels]) {
  for (int channel = 0; channel < 3; ++channel) {
    const float* const encoded = table.encoded[channel];
    for (int i = 0; i < kCellPixels; ++i) {
      const float place = roots[channel][i] * static_cast<float>(kWarpSteps);
      int step = static_cast<int>(place);
      step = step < static_cast<int>(kWarpSteps) - 1 ? step : static_cast<int>(kWarpSteps) - 1;
      const float a = encoded[step], b = encoded[step + 1];
      roots[channel][i] = a + (b - a) * (place - static_cast<float>(step));
    }
  }
  if (table.curve.values) throughCurves(table.curve, roots);
  if (table.solid.values) throughSolid(table.solid, roots);
  for (int channel = 0; channel < 3; ++channel)
    for (int i = 0; i < kCellPixels; ++i) {
      const float value = withinPicture(roots[channel][i], 1.0f) * 255.0f + 0.5f;
      pixels[i] |= static_cast<std::uint32_t>(static_cast<int>(value)) << (8 * channel);
    }
}

template <bool kThroughTable>
inline void light(const CellPlaces& at, const FacetPixels& from, const WarpLight& by,
                  std::uint32_t (&pixels)[kCellPixels]) {
  const float lastColumn = static_cast<float>(from.width - 1), lastRow = static_cast<float>(from.height - 1);
  const int mostColumn = static_cast<int>(from.width) - 2, mostRow = static_cast<int>(from.height) - 2;
  int index[kCellPixels];
  float across[kCellPixels], down[kCellPixels];
  for (int i = 0; i < kCellPixels; ++i) {
    const float u = withinPicture(at.u[i], lastColumn), v = withinPicture(at.v[i], lastRow);
    int column = static_cast<int>(u), row = static_cast<int>(v);
    column = column < mostColumn ? column : mostColumn;
    row = row < mostRow ? row : mostRow;
    across[i] = u - static_cast<float>(column);
    down[i] = v - static_cast<float>(row);
    index[i] = row * static_cast<int>(from.width) + column;
  }
  std::uint32_t corners[4][kCellPixels];
  const std::size_t pitch = std::size_t{from.width} * 4;
  for (int i = 0; i < kCellPixels; ++i) {
    const std::uint8_t* const first = from.rgba + static_cast<std::size_t>(index[i]) * 4;
    __builtin_memcpy(&corners[0][i], first, 4);
    __builtin_memcpy(&corners[1][i], first + 4, 4);
    __builtin_memcpy(&corners[2][i], first + pitch, 4);
    __builtin_memcpy(&corners[3][i], first + pitch + 4, 4);
  }
  for (int i = 0; i < kCellPixels; ++i) pixels[i] = 0xff000000u;
  [[maybe_unused]] float roots[kThroughTable ? 3 : 1][kCellPixels];
  for (int channel = 0; channel < 3; ++channel) {
    const int shift = 8 * channel;
    const float* const linear = by.linear.data();
    const float gain = by.gain[static_cast<std::size_t>(channel)];
    int step[kCellPixels];
    for (int i = 0; i < kCellPixels; ++i) {
      const float a = linear[corners[0][i] >> shift & 255], b = linear[corners[1][i] >> shift & 255];
      const float c = linear[corners[2][i] >> shift & 255], d = linear[corners[3][i] >> shift & 255];
      const float top = a + (b - a) * across[i], bottom = c + (d - c) * across[i];
      const float mean = top + (bottom - top) * down[i];
      float shown = mean * at.share[channel][i] * gain + at.lift[channel][i];
      shown = shown < 1.0f ? shown : 1.0f;
      shown = shown > 0.0f ? shown : 0.0f;
      const float root = __builtin_sqrtf(shown);
      if constexpr (kThroughTable)
        roots[channel][i] = root;
      else
        step[i] = static_cast<int>(root * static_cast<float>(kWarpSteps) + 0.5f);
    }
    if constexpr (kThroughTable) continue;
    const std::uint8_t* const encoded = by.encoded[static_cast<std::size_t>(channel)].data();
    for (int i = 0; i < kCellPixels; ++i) pixels[i] |= static_cast<std::uint32_t>(encoded[step[i]]) << shift;
  }
  if constexpr (kThroughTable) throughTable(*by.table, roots, pixels);
}

inline void light(const CellPlaces& at, const FacetPixels& from, const WarpLight& by,
                  std::uint32_t (&pixels)[kCellPixels]) {
  if (by.table) return light<true>(at, from, by, pixels);
  light<false>(at, from, by, pixels);
}

inline float between(float a, float b, float s) {
  return a + (b - a) * s;
}

inline WarpPoint between(const WarpPoint& a, const WarpPoint& b, float s) {
  return {
      between(a.x, b.x, s),
      between(a.y, b.y, s),
      between(a.w, b.w, s),
      {between(a.share[0], b.share[0], s), between(a.share[1], b.share[1], s),
       between(a.share[2], b.share[2], s)},
      {between(a.lift[0], b.lift[0], s), between(a.lift[1], b.lift[1], s), between(a.lift[2], b.lift[2], s)}};
}

void smoothCell(const WarpPoint (&corners)[4], const FacetPixels& from, const WarpLight& by,
                std::uint32_t (&pixels)[kCellPixels]) {
  CellPlaces at;
  for (int j = 0; j < kCellSide; ++j) {
    const float t = static_cast<float>(j) / kCellSide;
    const WarpPoint left = between(corners[0], corners[2], t), right = between(corners[1], corners[3], t);
    for (int i = 0; i < kCellSide; ++i) {
      const float s = static_cast<float>(i) / kCellSide;
      const int pixel = j * kCellSide + i;
      const float w = between(left.w, right.w, s);
      at.u[pixel] = between(left.x, right.x, s) / w;
      at.v[pixel] = between(left.y, right.y, s) / w;
      for (int channel = 0; channel < 3; ++channel) {
        at.share[channel][pixel] = between(left.share[channel], right.share[channel], s);
        at.lift[channel][pixel] = between(left.lift[channel], right.lift[channel], s);
      }
    }
  }
  light(at, from, by, pixels);
}

void exactCell(const WarpPoint (&points)[kCellPixels], const FacetPixels& from, const WarpLight& by,
               std::uint32_t (&pixels)[kCellPixels]) {
  CellPlaces at;
  for (int i = 0; i < kCellPixels; ++i) {
    at.u[i] = points[i].x / points[i].w;
    at.v[i] = points[i].y / points[i].w;
    for (int channel = 0; channel < 3; ++channel) {
      at.share[channel][i] = points[i].share[channel];
      at.lift[channel][i] = points[i].lift[channel];
    }
  }
  light(at, from, by, pixels);
}

}  // namespace
}  // namespace stadion
