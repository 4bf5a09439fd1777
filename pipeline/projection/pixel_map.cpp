#include "pipeline/projection/pixel_map.h"

#include <algorithm>
#include <utility>

namespace stadion {
namespace {

constexpr double kPointError = 0.05;  ///< of the distance between two pixels
constexpr double kShareError = 0.002;
constexpr double kLiftError = 1e-4;
constexpr std::uint32_t kCellPixels = PixelMap::kSide;

using Lit = std::function<std::optional<LitPoint>(double, double)>;

bool isDark(const MapPoint& p) {
  constexpr std::array<float, 3> kNone{};
  return p.share == kNone && p.lift == kNone;
}

class MapMaking {
public:
  MapMaking(PixelMap& map, const Lit& lit, DrawPool& pool, PixelMap::Edge edge)
      : map_(map), lit_(lit), pool_(pool), edge_(edge) {}

  void run() {
    const std::size_t across = map_.columns + 1;
    corners_.resize(across * (map_.rows + 1));
    pool_.run(map_.rows + 1, [&](std::size_t row) {
      for (std::size_t c = 0; c < across; ++c)
        corners_[row * across + c] =
            at(static_cast<double>(c * kCellPixels), static_cast<double>(row * kCellPixels));
    });
    std::vector<std::vector<MapPoint>> exact(map_.rows);
    pool_.run(map_.rows, [&](std::size_t row) {
      for (std::uint32_t c = 0; c < map_.columns; ++c) cell(static_cast<std::uint32_t>(row), c, exact[row]);
    });
    join(exact);
    for (const auto& corner : corners_) map_.corners.push_back(stored(corner));
  }

private:
  std::optional<LitPoint> at(double x, double y) const { return lit_(x + 0.5, y + 0.5); }

  /// As at(); a pixel whose centre lies just beyond the screen's edge continues its neighbours. A part of its
  /// light still falls on the screen.
  std::optional<LitPoint> atEdge(double x, double y) const {
    auto lit = at(x, y);
    if (lit || edge_ == PixelMap::Edge::Sharp) return lit;
    for (const double far : {1.0, 2.0})
      for (const auto& [i, j] :
           {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}, {1, 1}, {-1, 1}, {1, -1}, {-1, -1}}) {
        const auto near = at(x + far * i, y + far * j);
        if (!near) continue;
        const auto next = at(x + (far + 1) * i, y + (far + 1) * j);
        if (!next) continue;
        return LitPoint{near->point + far * (near->point - next->point),
                        (near->share + far * (near->share - next->share)).cwiseMax(0).cwiseMin(1),
                        (near->lift + far * (near->lift - next->lift)).cwiseMax(0).cwiseMin(1)};
      }
    return std::nullopt;
  }

  MapPoint stored(const std::optional<LitPoint>& p) const {
    if (!p) return {};
    const Eigen::Vector3f q = (p->point - map_.origin).cast<float>(), share = p->share.cast<float>(),
                          lift = p->lift.cast<float>();
    return {q.x(), q.y(), q.z(), {share.x(), share.y(), share.z()}, {lift.x(), lift.y(), lift.z()}};
  }

  /// Returns true if the cell's corners give what lies between them.
  bool isSmooth(const std::array<const LitPoint*, 4>& corners, double x, double y) const {
    const double pixel = (corners[1]->point - corners[0]->point).norm() / kCellPixels +
                         (corners[2]->point - corners[0]->point).norm() / kCellPixels;
    for (const auto& [i, j] : {std::pair{4, 4}, {4, 0}, {0, 4}, {4, 7}, {7, 4}}) {
      const auto exact = at(x + i, y + j);
      if (!exact) return false;
      const double s = i / double{kCellPixels}, t = j / double{kCellPixels};
      const std::array<double, 4> weights{(1 - s) * (1 - t), s * (1 - t), (1 - s) * t, s * t};
      LitPoint between;
      for (std::size_t k = 0; k < 4; ++k) {
        between.point += weights[k] * corners[k]->point;
        between.share += weights[k] * corners[k]->share;
        between.lift += weights[k] * corners[k]->lift;
      }
      if ((between.point - exact->point).norm() > 0.5 * kPointError * pixel ||
          (between.share - exact->share).cwiseAbs().maxCoeff() > kShareError ||
          (between.lift - exact->lift).cwiseAbs().maxCoeff() > kLiftError)
        return false;
    }
    return true;
  }

  void cell(std::uint32_t row, std::uint32_t column, std::vector<MapPoint>& exact) {
    const std::size_t across = map_.columns + 1, first = row * across + column;
    std::uint32_t& kind = map_.cells[std::size_t{row} * map_.columns + column];
    std::array<const LitPoint*, 4> corners{};
    bool whole = true;
    for (std::size_t k = 0; k < 4; ++k) {
      const auto& corner = corners_[first + k % 2 + k / 2 * across];
      whole &= corner.has_value();
      if (corner) corners[k] = &*corner;
    }
    const double x = column * kCellPixels, y = row * kCellPixels;
    if (whole && isSmooth(corners, x, y)) {
      kind = PixelMap::kSmooth;
      return;
    }
    const auto begin = static_cast<std::uint32_t>(exact.size());
    bool dark = true;
    for (std::uint32_t j = 0; j < kCellPixels; ++j)
      for (std::uint32_t i = 0; i < kCellPixels; ++i) {
        exact.push_back(stored(atEdge(x + i, y + j)));
        dark &= isDark(exact.back());
      }
    kind = dark ? PixelMap::kDark : begin;
    if (dark) exact.resize(begin);
  }

  void join(const std::vector<std::vector<MapPoint>>& exact) {
    for (std::uint32_t row = 0; row < map_.rows; ++row) {
      const auto begin = static_cast<std::uint32_t>(map_.pixels.size());
      for (std::uint32_t c = 0; c < map_.columns; ++c)
        if (std::uint32_t& kind = map_.cells[std::size_t{row} * map_.columns + c]; kind < PixelMap::kSmooth)
          kind += begin;
      map_.pixels.insert(map_.pixels.end(), exact[row].begin(), exact[row].end());
    }
  }

  PixelMap& map_;
  const Lit& lit_;
  DrawPool& pool_;
  const PixelMap::Edge edge_;
  std::vector<std::optional<LitPoint>> corners_;
};

}  // namespace

PixelMap makePixelMap(std::uint32_t width, std::uint32_t height, const Vec3& origin, const Lit& lit,
                      DrawPool& pool, PixelMap::Edge edge) {
  PixelMap map;
  map.width = width;
  map.height = height;
  map.columns = (width + kCellPixels - 1) / kCellPixels;
  map.rows = (height + kCellPixels - 1) / kCellPixels;
  map.origin = origin;
  map.cells.resize(std::size_t{map.columns} * map.rows);
  MapMaking(map, lit, pool, edge).run();
  return map;
}

}  // namespace stadion
