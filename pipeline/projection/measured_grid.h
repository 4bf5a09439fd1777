#pragma once
/// Finds the place in a measured image that lights a point.
///
/// Method   cells of at most 256 x 256 points lie in cubes of space; a search looks at the cells in one cube.
///          Each cell is two triangles. Where the image's border or the screen's edge cuts a cell, the missing
///          points are continued from their neighbours.
/// Units    metres. A place is in points of the image: (column, row), from -0.5 to their number - 0.5.
/// Threads  constant after it was made; then any.

#include "engine/display/projector.h"

#include <array>
#include <cstdint>
#include <optional>
#include <unordered_map>
#include <vector>

namespace stadion {

class MeasuredGrid {
public:
  MeasuredGrid() = default;
  explicit MeasuredGrid(const MeasuredImage& image);

  /// Returns the place whose point is nearest, if it is as near as a cell is large.
  std::optional<Vec2> placeOf(const Vec3& point) const;

private:
  struct Found {
    Vec2 place;
    double distance;
  };
  struct Corner {
    Vec2 place;
    Vec3 point;
  };

  void take(const MeasuredImage& image);
  void continueOnce();
  void setSide();
  void add(std::uint32_t cell);
  Corner cornerOf(std::uint32_t column, std::uint32_t row) const;
  void tryTriangle(const Vec3& point, const std::array<Corner, 3>& corners, std::optional<Found>& best) const;

  std::vector<double> columns_, rows_;  ///< places of the points that are kept
  std::vector<Vec3> points_;            ///< (rows x columns)
  double side_ = 1;                     ///< of a cube [m]
  std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> cells_;  ///< by cube: numbers of cells
};

}  // namespace stadion
