#include "engine/display/unfolding.h"

#include "engine/maths/functions.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <set>

namespace stadion {
namespace {

constexpr double kGap = 0.01;  ///< between walls, of the sheet's width

struct Cell {
  int column, row;
  auto operator<=>(const Cell&) const = default;
};

/// Which side of the room the wall is.
Cell sideOf(const Wall& wall) {
  const Vec3 n = basis(wall).normal;
  int axis = 0;
  n.cwiseAbs().maxCoeff(&axis);
  if (axis == 0) return n.x() > 0 ? Cell{0, 1} : Cell{2, 1};
  if (axis == 1) return n.y() < 0 ? Cell{1, 1} : Cell{3, 1};
  return n.z() > 0 ? Cell{1, 2} : Cell{1, 0};
}

/// How far to the left the wall's middle is seen from the rig's origin [rad].
double bearing(const Wall& wall) {
  const Vec3 c = wall.centre();
  return det::atan2(-c.x(), c.y());
}

std::vector<Cell> cellsOf(const std::vector<WallEntry>& walls) {
  std::vector<Cell> cells;
  for (const WallEntry& w : walls) cells.push_back(sideOf(w.wall));
  if (std::set<Cell>(cells.begin(), cells.end()).size() == cells.size()) return cells;
  std::vector<std::size_t> order(walls.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(
      order, [&](std::size_t a, std::size_t b) { return bearing(walls[a].wall) > bearing(walls[b].wall); });
  for (std::size_t i = 0; i < order.size(); ++i) cells[order[i]] = {static_cast<int>(i), 1};
  return cells;
}

/// Where columns (or rows) of these sizes begin, and where the last one ends.
std::map<int, double> begins(const std::map<int, double>& sizes, double gap, double& total) {
  std::map<int, double> at;
  total = 0;
  for (const auto& [i, size] : sizes) {
    if (total > 0) total += gap;
    at[i] = total;
    total += size;
  }
  return at;
}

}  // namespace

std::vector<SheetPlace> unfold(const std::vector<WallEntry>& walls, std::uint32_t width,
                               std::uint32_t height) {
  const std::vector<Cell> cells = cellsOf(walls);
  std::map<int, double> widths, heights;  // [m]
  for (std::size_t i = 0; i < walls.size(); ++i) {
    const WallBasis b = basis(walls[i].wall);
    widths[cells[i].column] = std::max(widths[cells[i].column], b.width);
    heights[cells[i].row] = std::max(heights[cells[i].row], b.height);
  }
  double across = 0, down = 0;
  for (const auto& [column, w] : widths) across += w;
  const double gap = walls.size() > 1 ? kGap * across : 0;
  const std::map<int, double> x = begins(widths, gap, across), y = begins(heights, gap, down);
  const double scale = std::min(width / across, height / down);  // [pixels/m]
  const double left = 0.5 * (width - scale * across), top = 0.5 * (height - scale * down);

  std::vector<SheetPlace> places;
  for (std::size_t i = 0; i < walls.size(); ++i) {
    const WallBasis b = basis(walls[i].wall);
    // In the middle of its cell, up against what it has an edge with.
    const double dx = 0.5 * (widths[cells[i].column] - b.width);
    const double dy = cells[i].row == 0   ? heights[cells[i].row] - b.height
                      : cells[i].row == 1 ? 0.5 * (heights[cells[i].row] - b.height)
                                          : 0;
    const auto pixels = [&](double metres) {
      return static_cast<std::uint32_t>(std::max(1.0, std::floor(scale * metres)));
    };
    places.push_back({static_cast<std::int32_t>(std::floor(left + scale * (x.at(cells[i].column) + dx))),
                      static_cast<std::int32_t>(std::floor(top + scale * (y.at(cells[i].row) + dy))),
                      pixels(b.width), pixels(b.height)});
  }
  return places;
}

}  // namespace stadion
