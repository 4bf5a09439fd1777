#include "engine/hall_formats/warp_mesh.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace stadion {
namespace {

constexpr std::uint64_t kMostPointTests = 60'000'000;
constexpr double kEdgeTolerance = 1e-9;  ///< of barycentric coordinates: no gap between neighbours

/// Which points of a row or column of the grid lie between two shares.
struct PointRange {
  std::uint32_t first = 0, end = 0;
};

PointRange pointsBetween(double lo, double hi, std::uint32_t count) {
  const double n = count;
  const double first = std::clamp(std::ceil(lo * n - 0.5 - 1e-6), 0.0, n);
  const double end = std::clamp(std::floor(hi * n - 0.5 + 1e-6) + 1, first, n);
  return {static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(end)};
}

class WarpSampler {
public:
  WarpSampler(const WarpMesh& mesh, SourceGrid& grid) : mesh_(mesh), grid_(grid) {}

  bool run() {
    std::uint64_t tests = 0;
    for (const auto& t : mesh_.triangles) tests += 1 + boundsOf(t).count();
    if (tests > kMostPointTests) return false;
    for (const auto& t : mesh_.triangles) triangle(t);
    return true;
  }

private:
  struct Bounds {
    PointRange across, down;
    std::uint64_t count() const { return std::uint64_t{across.end - across.first} * (down.end - down.first); }
  };
  using Corners = std::array<std::uint32_t, 3>;

  /// Which points of the grid a triangle may cover; none if it has no area.
  Bounds boundsOf(const Corners& t) const {
    const Vec2 &a = mesh_.vertices[t[0]].at, &b = mesh_.vertices[t[1]].at, &c = mesh_.vertices[t[2]].at;
    const Vec2 one = b - a, two = c - a;
    const double area = one.x() * two.y() - one.y() * two.x();
    if (!std::isfinite(area) || std::fabs(area) < 1e-15) return {};
    const Vec2 lo = a.cwiseMin(b).cwiseMin(c), hi = a.cwiseMax(b).cwiseMax(c);
    return {pointsBetween(lo.x(), hi.x(), grid_.columns), pointsBetween(lo.y(), hi.y(), grid_.rows)};
  }

  void triangle(const Corners& t) {
    const auto &a = mesh_.vertices[t[0]], &b = mesh_.vertices[t[1]], &c = mesh_.vertices[t[2]];
    const Vec2 one = b.at - a.at, two = c.at - a.at;
    const double area = one.x() * two.y() - one.y() * two.x();
    const auto [across, down] = boundsOf(t);
    for (std::uint32_t row = down.first; row < down.end; ++row)
      for (std::uint32_t column = across.first; column < across.end; ++column) {
        const Vec2 p = Vec2((column + 0.5) / grid_.columns, (row + 0.5) / grid_.rows) - a.at;
        const double v = (p.x() * two.y() - p.y() * two.x()) / area;
        const double w = (one.x() * p.y() - one.y() * p.x()) / area;
        if (v < -kEdgeTolerance || w < -kEdgeTolerance || v + w > 1 + kEdgeTolerance) continue;
        const std::size_t at = std::size_t{row} * grid_.columns + column;
        grid_.source[at] = a.source + v * (b.source - a.source) + w * (c.source - a.source);
        grid_.light[at] = std::clamp(a.light + v * (b.light - a.light) + w * (c.light - a.light), 0.0, 1.0);
      }
  }

  const WarpMesh& mesh_;
  SourceGrid& grid_;
};

}  // namespace

void addGridTriangles(WarpMesh& mesh, std::size_t columns, std::size_t rows) {
  for (std::size_t row = 0; row + 1 < rows; ++row)
    for (std::size_t column = 0; column + 1 < columns; ++column) {
      const auto at = static_cast<std::uint32_t>(row * columns + column);
      const auto below = static_cast<std::uint32_t>(at + columns);
      mesh.triangles.push_back({at, at + 1, below + 1});
      mesh.triangles.push_back({at, below + 1, below});
    }
}

std::optional<SourceGrid> sampleWarp(const WarpMesh& mesh, std::uint32_t columns, std::uint32_t rows) {
  SourceGrid grid;
  grid.columns = columns;
  grid.rows = rows;
  const std::size_t count = std::size_t{columns} * rows;
  grid.source.assign(count, Vec2::Constant(std::numeric_limits<double>::quiet_NaN()));
  grid.light.assign(count, 1);
  if (!WarpSampler(mesh, grid).run()) return std::nullopt;
  return grid;
}

std::optional<LightMap> lightOf(const SourceGrid& grid) {
  bool dimmed = false;
  for (std::size_t i = 0; i < grid.light.size(); ++i)
    dimmed = dimmed || (grid.light[i] < 1 && grid.source[i].allFinite());
  if (!dimmed) return std::nullopt;
  LightMap map;
  map.width = grid.columns;
  map.height = grid.rows;
  map.values.reserve(grid.light.size());
  for (const double light : grid.light)
    map.values.push_back(static_cast<std::uint16_t>(std::lround(light * 65535)));
  return map;
}

std::array<std::uint32_t, 2> gridSizeFor(std::uint32_t width, std::uint32_t height) {
  const auto points = [](std::uint32_t pixels) {
    return std::clamp<std::uint32_t>((pixels + 3) / 4, 32, 1024);
  };
  return {points(width), points(height)};
}

}  // namespace stadion
