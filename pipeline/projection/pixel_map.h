#pragma once
/// Which point of the screen each pixel of an output lights, and with which share of its light.
///
/// Method   cells of 8 x 8 pixels. In most cells points and shares are interpolated between the cell's
///          corners, which lie at pixels of the cells' first row and column. Where that is not exact enough,
///          at edges and creases, a cell keeps each of its pixels. With soft edges, pixels up to two beyond the
///          screen's edge are lit, too.
/// Exactness  points within 5 % of a pixel, shares within 0.2 %.
/// Frames   R is the rig; points are relative to `origin`.
/// Units    metres.
/// Threads  made by makePixelMap on any thread; then constant.

#include "engine/maths/maths.h"
#include "pipeline/platform/draw_pool.h"

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

namespace stadion {

/// What a pixel lights.
struct LitPoint {
  Vec3 point = Vec3::Zero();  ///< in R [m]
  Vec3 share = Vec3::Zero();  ///< of its light by channel, from 0 to 1
  Vec3 lift = Vec3::Zero();   ///< light that it adds so that black is as bright everywhere, by channel
};

/// A LitPoint as the map keeps it.
struct MapPoint {
  float x = 0, y = 0, z = 0;  ///< relative to the map's origin [m]
  std::array<float, 3> share{}, lift{};
};

struct PixelMap {
  /// What a pixel shows whose centre lies just beyond the screen's edge: Soft continues its neighbours, so that
  /// the last row on the screen is not too dark. Sharp leaves it dark.
  enum class Edge { Soft, Sharp };

  static constexpr std::uint32_t kSide = 8;  ///< of a cell [pixels]
  static constexpr std::uint32_t kPixels = kSide * kSide;
  static constexpr std::uint32_t kDark = ~0u, kSmooth = kDark - 1;

  std::uint32_t width = 0, height = 0;  ///< [pixels]
  std::uint32_t columns = 0, rows = 0;  ///< cells
  Vec3 origin = Vec3::Zero();
  std::vector<MapPoint> corners;  ///< of cells ((rows + 1) x (columns + 1))
  /// Cells (rows x columns): kDark, kSmooth, or the index of its first pixel in `pixels`.
  std::vector<std::uint32_t> cells;
  std::vector<MapPoint> pixels;  ///< of the exact cells, row by row
};

/// `lit(x, y)` returns what is lit at a place of the output [pixels], with a pixel's centre at 0.5. It is
/// called on the pool's threads. It may be asked for places up to 8 pixels outside of the output.
PixelMap makePixelMap(std::uint32_t width, std::uint32_t height, const Vec3& origin,
                      const std::function<std::optional<LitPoint>(double x, double y)>& lit, DrawPool& pool,
                      PixelMap::Edge edge = PixelMap::Edge::Soft);

}  // namespace stadion
